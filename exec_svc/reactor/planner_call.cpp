#include "exec_svc/reactor/planner_call.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::reactor {

using temporal::Time;
using temporal::Verdict;

namespace {

/// Bounds the calls in a row that are given up for a changed model; after that many the reply is taken, and
/// later changes show in the execution.
constexpr std::uint32_t kStaleLimit = 5;

/// Sets the pause before the next call after one that failed; it doubles with each failure in a row, up to a
/// bound.
constexpr double kFirstPauseS = 10;
constexpr std::uint32_t kMostDoublings = 4;

constexpr char kModelChanged[] = "a map or arm model changed";

}  // namespace

std::string PlannerCall::next_name() const { return state_->mission->name + "-" + std::to_string(id_ + 1); }

void PlannerCall::send(PlanRequest request) {
  ++state_->counts.planner_calls;
  request_ = std::move(request);
  models_changed_ = false;
  blind_ = !away_.empty();
  resend();
}

void PlannerCall::resend() {
  request_.id = ++id_;
  open_ = true;
  cancelled_ = false;
  state_->out.call = request_;
}

const PlanReply* PlannerCall::take(const ReactorInputs& inputs) {
  if (!open_ || !inputs.reply || inputs.reply->call != id_) return nullptr;
  open_ = false;
  return &*inputs.reply;
}

std::vector<ModelVersion> PlannerCall::note_models(const std::vector<ModelVersion>& models) {
  std::vector<ModelVersion> newer;
  for (const ModelVersion& model : models) {
    const auto [known, is_new] = models_.try_emplace(model.owner, model.version);
    if (is_new || known->second == model.version) continue;
    if (known->second < model.version) newer.push_back(model);
    known->second = model.version;
    models_changed_ = true;
  }
  return newer;
}

void PlannerCall::cancel_if_stale(bool reply_wanted) {
  if (!open_ || cancelled_) return;
  const bool by_models = models_changed_ && stale_in_a_row_ < kStaleLimit;
  if (reply_wanted && !state_->goals.open().empty() && !by_models) return;
  std::string reason = by_models ? kModelChanged : "no goal is open any more";
  if (!reply_wanted)
    reason = state_->phase == MissionPhase::safe ? "the robot was made safe" : state_->replan_reason;
  cancelled_ = true;
  if (reply_wanted && by_models) ++stale_in_a_row_;
  state_->out.cancelled_call = request_.id;
  state_->report(Severity::info, "plan.outdated",
                 "planner call " + std::to_string(request_.id) + " is cancelled: " + reason);
}

bool PlannerCall::is_end_of_cancelled(const PlanReply& reply) const {
  return cancelled_ && reply.verdict == Verdict::cancelled;
}

bool PlannerCall::is_stale(const PlanReply& reply) const {
  if (speaks_of_goals(reply.verdict)) return models_changed_;
  const auto& uses = reply.plan.function_values;
  return reply.verdict == Verdict::solved &&
         std::any_of(uses.begin(), uses.end(), [this](const temporal::FunctionValueUse& use) {
           const auto model = models_.find(use.owner);
           return model != models_.end() && use.model_version < model->second;
         });
}

bool PlannerCall::count_as_stale(const PlanReply& reply) {
  if (!is_stale(reply) || (!cancelled_ && stale_in_a_row_ >= kStaleLimit)) return false;
  if (!cancelled_) {
    ++stale_in_a_row_;
    state_->report(Severity::info, "plan.outdated",
                   std::string(kModelChanged) + " during the planner call; it is made again");
  }
  return true;
}

void PlannerCall::note_lost(const std::string& service) {
  away_.insert(service);
  blind_ = true;
}

std::string PlannerCall::away() const {
  std::string out;
  for (const std::string& service : away_) out += (out.empty() ? "" : ", ") + service;
  return out;
}

bool PlannerCall::back_off(Time now) {
  if (++failures_ > state_->mission->executive.call_retries) return false;
  const std::uint32_t doublings = std::min(failures_ - 1, kMostDoublings);
  not_before_ = now + temporal::seconds(kFirstPauseS * static_cast<double>(1U << doublings));
  return true;
}

}  // namespace roci::exec::reactor
