#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

using temporal::Duration;
using temporal::PlanActivity;
using temporal::Time;

void StartWaits::consider(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  const bool waits = state_->runs[activity].phase == ActivityPhase::waiting;
  if (!waits || !temporal::bounded(planned.wait_timeout)) return;
  if (state_->points.due(planned.start_point) && !state_->points.held(planned.start_point))
    begin(activity, now, planned.wait_timeout);
}

void StartWaits::begin(Index activity, Time now, Duration bound) {
  ActivityRun& run = state_->runs[activity];
  if (run.wait_until) return;
  run.wait_until = temporal::plus(now, bound);
  ends_.emplace(*run.wait_until, activity);
  const PlanActivity& planned = state_->plan.activities[activity];
  const bool pushed = planned.lateness == temporal::LatenessPolicy::push;
  if (!pushed || !state_->points.due(planned.start_point)) return;
  const std::string unmet = explain(planned.pre, state_->lookup());
  if (!unmet.empty())
    state_->report_recovery(RecoveryAction::push, activity,
                            "waits until " + temporal::to_text(*run.wait_until) + " for " + unmet);
}

void StartWaits::inherit(Index activity, Time until) {
  state_->runs[activity].wait_until = until;
  ends_.emplace(until, activity);
}

std::optional<Index> StartWaits::take_expired(Time now) {
  forget_started();
  if (ends_.empty() || ends_.begin()->first > now) return std::nullopt;
  return ends_.extract(ends_.begin()).value().second;
}

std::optional<Time> StartWaits::next_end() {
  forget_started();
  return ends_.empty() ? std::nullopt : std::optional(ends_.begin()->first);
}

void StartWaits::forget_started() {
  while (!ends_.empty() && state_->runs[ends_.begin()->second].phase != ActivityPhase::waiting)
    ends_.erase(ends_.begin());
}

}  // namespace roci::exec::executive
