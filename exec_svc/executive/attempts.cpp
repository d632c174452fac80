#include "exec_svc/executive/attempts.hpp"

#include <utility>

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::Duration;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;
using temporal::TimePoint;
using temporal::Truth;

void Attempts::start(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  ActivityRun& run = state_->runs[activity];
  run.started = run.attempt_started = now;
  run.maintenance_held = evaluate(planned.maintenance, state_->lookup()) == Truth::yes;
  state_->store.begin(planned);
  if (planned.owner.empty()) {
    state_->enter(activity, ActivityPhase::running, now);
    state_->change(activity, ActivityState::running, "");
  } else {
    ++run.attempt;
    run.latest_end = deadlines_->latest_end(activity);
    state_->enter(activity, ActivityPhase::sent, now);
    state_->send(activity, CommandAction::execute);
    state_->change(activity, ActivityState::dispatched, "");
  }
}

bool Attempts::send_next(Index activity, Time now) {
  if (state_->command(activity).last) return false;
  ActivityRun& run = state_->runs[activity];
  ++run.command;
  ++run.attempt;
  state_->enter(activity, ActivityPhase::sent, now);
  state_->send(activity, CommandAction::execute);
  state_->change(activity, ActivityState::running,
                 "command " + std::to_string(run.command + 1) + " of " +
                     std::to_string(state_->plan.activities[activity].then.size() + 1));
  return true;
}

void Attempts::succeed(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  if (!planned.owner.empty()) {
    state_->points.happen(planned.end_point, now);
    ended_now_.push_back(activity);
  }
  state_->close(activity, now, ActivityState::succeeded, "");
}

void Attempts::fail(Index activity, Time now, Breakage breakage, const std::string& reason,
                    bool still_commanded) {
  const PlanActivity& planned = state_->plan.activities[activity];
  const bool may_recover =
      breakage == Breakage::activity_failed && contingencies_->usable(activity) != nullptr;
  if (may_recover && !still_commanded && contingencies_->begin(activity, now, reason)) return;
  if (may_recover && still_commanded) return cancel(activity, now, AfterCancel::fail, reason);
  if (fails_alone(activity, breakage)) {
    if (still_commanded) return cancel(activity, now, AfterCancel::fail, reason);
    return close_alone(activity, now, reason);
  }
  state_->break_plan(breakage, planned.id, reason, planned.contingency);
  if (still_commanded) {
    cancel(activity, now, AfterCancel::fail, reason);
  } else {
    state_->close(activity, now, ActivityState::failed, reason);
  }
}

/// A passed deadline concerns the whole network, so it never fails alone.
bool Attempts::fails_alone(Index activity, Breakage breakage) const {
  return state_->starting() &&
         state_->plan.activities[activity].failure == temporal::FailureScope::of_activity &&
         (breakage == Breakage::activity_failed || breakage == Breakage::refused_for_good);
}

/// Closes the activity; its neighbours keep their order, as with one that is skipped.
void Attempts::close_alone(Index activity, Time now, const std::string& reason) {
  const PlanActivity& planned = state_->plan.activities[activity];
  if (!state_->runs[activity].started) state_->points.drop(planned.start_point);
  state_->points.drop(planned.end_point);
  state_->close(activity, now, ActivityState::failed, reason + "; it fails alone");
}

void Attempts::fail_or_retry(Index activity, Time now, const std::string& reason) {
  if (!retry(activity, now, reason)) fail(activity, now, Breakage::activity_failed, reason, false);
}

/// Tries the same activity again at once (R99), if its preconditions still hold; its duration counts from
/// now.
bool Attempts::retry(Index activity, Time now, const std::string& reason) {
  const PlanActivity& planned = state_->plan.activities[activity];
  ActivityRun& run = state_->runs[activity];
  if (!state_->starting() || !state_->permissions.recovers || run.retries_used >= planned.retries ||
      !deadlines_->leaves_room(activity, now))
    return false;
  const auto within = state_->settings.retry_within.find(planned.name);
  if (within != state_->settings.retry_within.end() && now > plus(*run.started, within->second)) return false;
  if (evaluate(planned.pre, state_->lookup_to_retry(activity)) != Truth::yes) return false;
  ++run.retries_used;
  state_->report_recovery(RecoveryAction::retry, activity,
                          "retry " + std::to_string(run.retries_used) + " of " +
                              std::to_string(planned.retries) + " after: " + reason);
  try_again(activity, now, "retry after: " + reason);
  return true;
}

void Attempts::try_again(Index activity, Time now, const std::string& reason) {
  ActivityRun& run = state_->runs[activity];
  ++run.attempt;
  run.command = 0;
  run.attempt_started = now;
  run.overrun_noted = false;
  const Duration spent = now - *run.started;
  const temporal::Window duration = state_->points.duration(activity);
  const bool keeps_end =
      state_->plan.activities[activity].lateness == temporal::LatenessPolicy::deadline;  // R129
  state_->points.set_duration(activity, plus(spent, duration.lower),
                              keeps_end ? duration.upper : plus(spent, duration.upper));
  run.latest_end = deadlines_->latest_end(activity);
  state_->enter(activity, ActivityPhase::sent, now);
  state_->send(activity, CommandAction::execute);
  state_->change(activity, ActivityState::dispatched, reason);
}

void Attempts::cancel(Index activity, Time now, AfterCancel after, const std::string& reason) {
  ActivityRun& run = state_->runs[activity];
  state_->enter(activity, ActivityPhase::cancelling, now);
  run.after_cancel = after;
  state_->send(activity, CommandAction::cancel);
  state_->change(activity, run.state, reason);
}

void Attempts::resume_after(const ContingencyEnd& end, Time now) {
  const Index activity = end.activity;
  const Contingency& contingency =
      state_->settings.contingencies.at(state_->plan.activities[activity].contingency);
  const std::string what = "contingency " + contingency.name;
  const bool done = end.reason.empty();
  if (done && contingency.retries && state_->starting() && deadlines_->leaves_room(activity, now)) {
    state_->report_recovery(RecoveryAction::contingency, activity,
                            contingency.name + " is done, the activity is tried again");
    try_again(activity, now, "tried again after " + what);
    return;
  }
  contingencies_->exhaust(activity);
  fail(activity, now, Breakage::activity_failed,
       end.failure + "; " + what + (done ? " is done" : " did not help: " + end.reason), false);
}

void Attempts::check_order_of_ends() {
  const PointDispatcher& points = state_->points;
  for (const Index ended : std::exchange(ended_now_, {})) {
    const PlanActivity& planned = state_->plan.activities[ended];
    for (const TimePoint point : points.precedence().predecessors[planned.end_point]) {
      const PointOwner& owner = points.owner(point);
      if (owner.role != PointRole::observed_end || points.happened_at(point) || points.dropped(point))
        continue;
      if (state_->runs[owner.activity].phase == ActivityPhase::settling) continue;
      state_->break_plan(Breakage::ordering_violated, planned.id,
                         "it ended before " + state_->plan.activities[owner.activity].id + " had ended",
                         planned.contingency);
    }
  }
}

}  // namespace roci::exec::executive
