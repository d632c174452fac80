// Reactor: when a planner call, or its answer, no longer speaks of what is so. Such a call is cancelled; the
// next one is made when it has ended.
#include <algorithm>

#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {
namespace {

// Calls given up for a changed model, in a row; after that many the answer is taken: what has changed since
// shows in the execution.
constexpr std::uint32_t kOutdatedLimit = 5;

constexpr char kModelChanged[] = "a map or arm model changed";

}  // namespace

void Reactor::cancel_stale_call() {
  if (!call_open_ || call_cancelled_) return;
  const bool by_models = models_changed_ && outdated_calls_ < kOutdatedLimit;
  const bool wants_answer = (phase_ == MissionPhase::planning || meanwhile_) && !wanted_;
  if (wants_answer && !goals_.open().empty() && !by_models) return;
  std::string why = by_models ? kModelChanged : "no goal is open any more";
  if (!wants_answer) why = phase_ == MissionPhase::safe ? "the robot was made safe" : wanted_why_;
  call_cancelled_ = true;
  if (wants_answer && by_models) ++outdated_calls_;
  out_.cancelled_call = call_.id;
  note(NoteLevel::info, "plan.outdated",
       "planner call " + std::to_string(call_.id) + " is cancelled: " + why);
}

bool Reactor::is_end_of_cancelled_call(const PlanAnswer& answer) const {
  return call_cancelled_ && answer.verdict == PlanVerdict::cancelled;
}

// A plan is out of date if a value in it stands on an older model; a verdict on the goals, if any model has
// changed.
bool Reactor::outdated(const PlanAnswer& answer) const {
  if (speaks_of_goals(answer.verdict)) return models_changed_;
  const auto& uses = answer.plan.function_values;
  return answer.verdict == PlanVerdict::solved &&
         std::any_of(uses.begin(), uses.end(), [this](const temporal::FunctionValueUse& use) {
           const auto model = models_.find(use.owner);
           return model != models_.end() && use.model_version < model->second;
         });
}

// The answer came with the change, or too fast for the cancel.
bool Reactor::count_as_outdated(const PlanAnswer& answer) {
  if (!outdated(answer) || (!call_cancelled_ && outdated_calls_ >= kOutdatedLimit)) return false;
  if (!call_cancelled_) {
    ++outdated_calls_;
    note(NoteLevel::info, "plan.outdated",
         std::string(kModelChanged) + " during the planner call; it is made again");
  }
  return true;
}

}  // namespace roci::exec::reactor
