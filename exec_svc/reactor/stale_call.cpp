// Reactor: when a planner call, or its answer, no longer speaks of what is so. Such a call is cancelled; the
// next one is made when it has ended.
#include <algorithm>

#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using temporal::Verdict;
namespace {

// Calls given up for a changed model, in a row; after that many the answer is taken: what has changed since
// shows in the execution.
constexpr std::uint32_t kStaleLimit = 5;

constexpr char kModelChanged[] = "a map or arm model changed";

}  // namespace

void Reactor::cancel_stale_call() {
  if (!call_open_ || call_cancelled_) return;
  const bool by_models = models_changed_ && stale_calls_ < kStaleLimit;
  const bool wants_answer = (phase_ == MissionPhase::planning || background_replan_) && !replan_wanted_;
  if (wants_answer && !goals_.open().empty() && !by_models) return;
  std::string reason = by_models ? kModelChanged : "no goal is open any more";
  if (!wants_answer) reason = phase_ == MissionPhase::safe ? "the robot was made safe" : replan_reason_;
  call_cancelled_ = true;
  if (wants_answer && by_models) ++stale_calls_;
  out_.cancelled_call = call_.id;
  report(Severity::info, "plan.outdated",
         "planner call " + std::to_string(call_.id) + " is cancelled: " + reason);
}

bool Reactor::is_end_of_cancelled_call(const PlanReply& reply) const {
  return call_cancelled_ && reply.verdict == Verdict::cancelled;
}

// A plan is out of date if a value in it stands on an older model; a verdict on the goals, if any model has
// changed.
bool Reactor::is_stale(const PlanReply& reply) const {
  if (speaks_of_goals(reply.verdict)) return models_changed_;
  const auto& uses = reply.plan.function_values;
  return reply.verdict == Verdict::solved &&
         std::any_of(uses.begin(), uses.end(), [this](const temporal::FunctionValueUse& use) {
           const auto model = models_.find(use.owner);
           return model != models_.end() && use.model_version < model->second;
         });
}

// The answer came with the change, or too fast for the cancel.
bool Reactor::count_as_stale(const PlanReply& reply) {
  if (!is_stale(reply) || (!call_cancelled_ && stale_calls_ >= kStaleLimit)) return false;
  if (!call_cancelled_) {
    ++stale_calls_;
    report(Severity::info, "plan.outdated",
           std::string(kModelChanged) + " during the planner call; it is made again");
  }
  return true;
}

}  // namespace roci::exec::reactor
