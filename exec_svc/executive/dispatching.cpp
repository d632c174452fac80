// Points that may happen now: starts, ends without command, free points; and starts that may not.
#include <algorithm>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::bounded;
using temporal::Duration;
using temporal::LatenessPolicy;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;
using temporal::TimePoint;
using temporal::to_text;
using temporal::Truth;

bool PlanRun::dispatch(Time now) {
  bool progress = false;
  for (const TimePoint point : points_.advance(now))
    if (points_.owner(point).role == PointRole::start) consider_wait(points_.owner(point).activity, now);
  const std::vector<TimePoint> ready(points_.ready().begin(), points_.ready().end());
  for (const TimePoint point : ready)
    if (points_.ready().contains(point)) progress = attempt(point, now) || progress;
  return progress;
}

bool PlanRun::attempt(TimePoint point, Time now) {
  const PointOwner& owner = points_.owner(point);
  if (owner.role == PointRole::start) return starting() && !held_ && try_start(owner.activity, now);
  if (owner.role == PointRole::internal_end) return try_internal_end(owner.activity, now);
  return points_.try_happen(point, now);
}

bool PlanRun::try_start(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (run.phase != ActivityPhase::waiting) return false;
  if (!planned.skip_if.empty() && evaluate(planned.skip_if, lookup()) == Truth::yes) {
    skip(activity, "skipped: " + describe(planned.skip_if));
    return true;
  }
  std::string unmet = explain(planned.pre, lookup());
  for (const TimePoint point : points_.precedence().together[planned.start_point]) {
    const Index other = points_.owner(point).activity;
    if (!unmet.empty() || runs_[other].phase != ActivityPhase::waiting) continue;
    unmet = explain(plan_.activities[other].pre, lookup());
    if (!unmet.empty()) unmet = plan_.activities[other].id + " at the same time, which needs " + unmet;
  }
  if (!unmet.empty()) {
    run.reason = "waits for " + unmet;
    begin_wait(activity, now, bounded(planned.wait_timeout) ? planned.wait_timeout : settings_.default_wait);
    return false;
  }
  if (!points_.try_happen(planned.start_point, now)) return false;
  start(activity, now);
  return true;
}

void PlanRun::start(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  run.started = run.attempt_started = now;
  run.maintenance_held = evaluate(planned.maintenance, lookup()) == Truth::yes;
  if (planned.owner.empty()) {
    enter(activity, ActivityPhase::running, now);
    store_.begin(planned);
    change(activity, ActivityState::running, "");
  } else {
    ++run.attempt;
    enter(activity, ActivityPhase::sent, now);
    send(activity, CommandAction::execute);
    change(activity, ActivityState::dispatched, "");
  }
}

bool PlanRun::try_internal_end(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (run.phase != ActivityPhase::running && run.phase != ActivityPhase::settling) return false;
  if (evaluate(planned.post, lookup()) != Truth::yes) {
    if (run.phase == ActivityPhase::running) enter(activity, ActivityPhase::settling, now);
    return false;
  }
  if (!points_.try_happen(planned.end_point, now)) return false;
  succeed(activity, now);
  return true;
}

void PlanRun::skip(Index activity, const std::string& reason) {
  const PlanActivity& planned = plan_.activities[activity];
  enter(activity, ActivityPhase::done, {});
  points_.drop(planned.start_point);
  points_.drop(planned.end_point);
  change(activity, ActivityState::skipped, reason);
}

/// A stated wait timeout counts from the earliest start on, also while a predecessor that runs is late (R98),
/// but not while a predecessor has not even begun (that one's own wait bounds this one) or a decision is
/// open.
void PlanRun::consider_wait(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  if (runs_[activity].phase != ActivityPhase::waiting || !bounded(planned.wait_timeout)) return;
  if (points_.due(planned.start_point) && !points_.held(planned.start_point))
    begin_wait(activity, now, planned.wait_timeout);
}

void PlanRun::begin_wait(Index activity, Time now, Duration bound) {
  ActivityRun& run = runs_[activity];
  if (run.wait_until) return;
  run.wait_until = plus(now, bound);
  waits_.emplace(*run.wait_until, activity);
  const PlanActivity& planned = plan_.activities[activity];
  if (planned.lateness != LatenessPolicy::push || !points_.due(planned.start_point)) return;
  const std::string unmet = explain(planned.pre, lookup());
  if (!unmet.empty())
    recover(RecoveryAction::push, activity, "waits until " + to_text(*run.wait_until) + " for " + unmet);
}

bool PlanRun::expire_waits(Time now) {
  bool progress = false;
  while (starting() && !waits_.empty() && waits_.begin()->first <= now) {
    const Index activity = waits_.begin()->second;
    waits_.erase(waits_.begin());
    const PlanActivity& planned = plan_.activities[activity];
    const std::string unmet = explain(planned.pre, lookup());
    const std::string reason =
        "could not start within its wait timeout: " + (unmet.empty() ? "a predecessor has not ended" : unmet);
    if (planned.may_skip) {
      skip(activity, reason);
    } else {
      fail(activity, now, Breakage::activity_failed, reason, false);
    }
    progress = true;
  }
  return progress;
}

/// An activity whose longest duration has passed breaks nothing: from then on that duration no longer bounds
/// its end (nor, through it, the latest times of others). Under LatenessPolicy::deadline it does.
void PlanRun::note_overruns(Time now) {
  for (const Index i : active_) {
    ActivityRun& run = runs_[i];
    const temporal::Window planned = points_.duration(i);
    if (run.overrun_noted || now <= plus(run.attempt_started, planned.upper)) continue;
    if (plan_.activities[i].lateness == LatenessPolicy::deadline) continue;
    run.overrun_noted = true;
    points_.set_duration(i, run.attempt_started - *run.started + planned.lower, temporal::no_bound);
  }
}

/// R49: a start whose latest time has passed breaks the plan.
void PlanRun::break_if_late(Time now) {
  if (!starting()) return;
  const auto late = points_.late_start(now);
  if (!late) return;
  const Index activity = points_.owner(*late).activity;
  const PlanActivity& planned = plan_.activities[activity];
  std::string reason = "latest start " + to_text(points_.window(*late).upper) + " has passed";
  if (const std::string unmet = explain(planned.pre, lookup()); !unmet.empty())
    reason += "; it needs " + unmet;
  for (const TimePoint point : points_.precedence().predecessors[planned.start_point]) {
    const PointOwner& owner = points_.owner(point);
    if (owner.role == PointRole::free || points_.happened_at(point) || points_.dropped(point)) continue;
    reason += "; it waits for " + plan_.activities[owner.activity].id;
  }
  break_plan(Breakage::late_start, planned.id, reason, planned.contingency);
}

/// Ends come as they come; two that came in the wrong order cannot be mended by waiting.
void PlanRun::break_if_disordered() {
  for (const Index ended : ended_now_) {
    const PlanActivity& planned = plan_.activities[ended];
    for (const TimePoint point : points_.precedence().predecessors[planned.end_point]) {
      const PointOwner& owner = points_.owner(point);
      if (owner.role != PointRole::observed_end || points_.happened_at(point) || points_.dropped(point))
        continue;
      if (runs_[owner.activity].phase == ActivityPhase::settling) continue;
      break_plan(Breakage::ordering_violated, planned.id,
                 "it ended before " + plan_.activities[owner.activity].id + " had ended",
                 planned.contingency);
    }
  }
  ended_now_.clear();
}

}  // namespace roci::exec::executive
