#include "exec_svc/executive/dispatch.hpp"

#include <string>
#include <utility>
#include <vector>

namespace roci::exec::executive {

using temporal::bounded;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;
using temporal::Truth;

bool Dispatch::let_happen(Time now) {
  PointDispatcher& points = state_->points;
  bool progress = false;
  for (const TimePoint point : points.advance(now))
    if (points.owner(point).role == PointRole::start) waits_->consider(points.owner(point).activity, now);
  for (const TimePoint point : state_->ready_points())
    if (points.ready().contains(point)) progress = attempt(point, now) || progress;
  return progress;
}

bool Dispatch::attempt(TimePoint point, Time now) {
  const PointOwner& owner = state_->points.owner(point);
  if (owner.role == PointRole::start)
    return state_->starting() && !starts_held_ && try_start(owner.activity, now);
  if (owner.role == PointRole::internal_end) return try_internal_end(owner.activity, now);
  return state_->points.try_happen(point, now);
}

bool Dispatch::try_start(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  ActivityRun& run = state_->runs[activity];
  if (run.phase != ActivityPhase::waiting) return false;
  if (std::string refused = refusal(activity); !refused.empty()) {
    if (run.reason != refused) state_->change(activity, run.state, std::move(refused));  // the ground sees it
    return false;
  }
  if (!planned.skip_if.empty() && evaluate(planned.skip_if, state_->lookup()) == Truth::yes) {
    state_->skip(activity, "skipped: " + describe(planned.skip_if));
    return true;
  }
  if (const std::string unmet = unmet_preconditions(activity); !unmet.empty()) {
    run.reason = "waits for " + unmet;
    waits_->begin(activity, now,
                  bounded(planned.wait_timeout) ? planned.wait_timeout : state_->settings.default_wait);
    return false;
  }
  if (!state_->points.try_happen(planned.start_point, now)) return false;
  attempts_->start(activity, now);
  return true;
}

/// Returns why the ground does not let it start, or an activity that must start at the same time, in words.
std::string Dispatch::refusal(Index activity) const {
  const auto refused = [this](Index one) {
    const PlanActivity& planned = state_->plan.activities[one];
    return state_->permissions.refusal(planned.id, !planned.owner.empty());
  };
  std::string out = refused(activity);
  if (!out.empty()) return out;
  for (const TimePoint point :
       state_->points.precedence().together[state_->plan.activities[activity].start_point]) {
    const Index other = state_->points.owner(point).activity;
    if (state_->runs[other].phase != ActivityPhase::waiting) continue;
    if (out = refused(other); !out.empty())
      return state_->plan.activities[other].id + " at the same time must not start: " + out;
  }
  return "";
}

/// Returns its own unmet preconditions, else those of an activity that must start at the same time, in words.
std::string Dispatch::unmet_preconditions(Index activity) const {
  const PlanActivity& planned = state_->plan.activities[activity];
  std::string unmet = explain(planned.pre, state_->lookup());
  for (const TimePoint point : state_->points.precedence().together[planned.start_point]) {
    const Index other = state_->points.owner(point).activity;
    if (!unmet.empty() || state_->runs[other].phase != ActivityPhase::waiting) continue;
    unmet = explain(state_->plan.activities[other].pre, state_->lookup());
    if (!unmet.empty()) unmet = state_->plan.activities[other].id + " at the same time, which needs " + unmet;
  }
  return unmet;
}

bool Dispatch::try_internal_end(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  const ActivityRun& run = state_->runs[activity];
  if (run.phase != ActivityPhase::running && run.phase != ActivityPhase::settling) return false;
  if (evaluate(planned.post, state_->lookup()) != Truth::yes) {
    if (run.phase == ActivityPhase::running) state_->enter(activity, ActivityPhase::settling, now);
    return false;
  }
  if (!state_->points.try_happen(planned.end_point, now)) return false;
  attempts_->succeed(activity, now);
  return true;
}

bool Dispatch::expire_waits(Time now) {
  bool progress = false;
  while (state_->starting()) {
    const auto activity = waits_->take_expired(now);
    if (!activity) break;
    const PlanActivity& planned = state_->plan.activities[*activity];
    const std::string unmet = explain(planned.pre, state_->lookup());
    const std::string reason =
        "could not start within its wait timeout: " + (unmet.empty() ? "a predecessor has not ended" : unmet);
    if (planned.may_skip) {
      state_->skip(*activity, reason);
    } else {
      attempts_->fail(*activity, now, Breakage::activity_failed, reason, false);
    }
    progress = true;
  }
  return progress;
}

void Dispatch::break_if_late(Time now) {
  if (!state_->starting()) return;
  const PointDispatcher& points = state_->points;
  const auto late = state_->points.late_start(now);
  if (!late) return;
  const PlanActivity& planned = state_->plan.activities[points.owner(*late).activity];
  std::string reason = "latest start " + temporal::to_text(points.window(*late).upper) + " has passed";
  if (const std::string unmet = explain(planned.pre, state_->lookup()); !unmet.empty())
    reason += "; it needs " + unmet;
  for (const TimePoint point : points.precedence().predecessors[planned.start_point]) {
    const PointOwner& owner = points.owner(point);
    if (owner.role == PointRole::free || points.happened_at(point) || points.dropped(point)) continue;
    reason += "; it waits for " + state_->plan.activities[owner.activity].id;
  }
  state_->break_plan(Breakage::late_start, planned.id, reason, planned.contingency);
}

}  // namespace roci::exec::executive
