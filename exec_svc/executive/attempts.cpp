// How an attempt at an activity ends: success, failure, another attempt, cancel.
#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::Duration;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;
using temporal::Truth;

void PlanRun::succeed(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  if (!planned.owner.empty()) {
    points_.happen(planned.end_point, now);
    ended_now_.push_back(activity);
  }
  close(activity, now, ActivityState::succeeded, "");
}

void PlanRun::fail(Index activity, Time now, Breakage breakage, const std::string& reason,
                   bool still_commanded) {
  const bool may_recover = breakage == Breakage::activity_failed && contingency_of(activity) != nullptr;
  if (may_recover && !still_commanded && begin_contingency(activity, now, reason)) return;
  if (may_recover && still_commanded) {
    cancel(activity, now, AfterCancel::fail, reason);
    return;
  }
  break_plan(breakage, plan_.activities[activity].id, reason, plan_.activities[activity].contingency);
  if (still_commanded) {
    cancel(activity, now, AfterCancel::fail, reason);
  } else {
    close(activity, now, ActivityState::failed, reason);
  }
}

void PlanRun::fail_or_retry(Index activity, Time now, const std::string& reason) {
  if (!retry(activity, now, reason)) fail(activity, now, Breakage::activity_failed, reason, false);
}

/// R99: the same activity again at once, if its preconditions still hold; its duration counts from now.
bool PlanRun::retry(Index activity, Time now, const std::string& reason) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (!starting() || run.retries_used >= planned.retries || now > deadline(activity)) return false;
  const auto within = settings_.retry_within.find(planned.name);
  if (within != settings_.retry_within.end() && now > plus(*run.started, within->second)) return false;
  if (evaluate(planned.pre, lookup()) != Truth::yes) return false;
  ++run.retries_used;
  recover(RecoveryAction::retry, activity,
          "retry " + std::to_string(run.retries_used) + " of " + std::to_string(planned.retries) +
              " after: " + reason);
  try_again(activity, now, "retry after: " + reason);
  return true;
}

void PlanRun::try_again(Index activity, Time now, const std::string& reason) {
  ActivityRun& run = runs_[activity];
  ++run.attempt;
  run.attempt_started = now;
  run.overrun_noted = false;
  const Duration spent = now - *run.started;
  const temporal::Window duration = points_.duration(activity);
  points_.set_duration(activity, plus(spent, duration.lower), plus(spent, duration.upper));
  enter(activity, ActivityPhase::sent, now);
  send(activity, CommandAction::execute);
  change(activity, ActivityState::dispatched, reason);
}

void PlanRun::close(Index activity, Time now, ActivityState state, const std::string& reason) {
  ActivityRun& run = runs_[activity];
  if (run.started) run.ended = now;
  if (plan_.activities[activity].owner.empty() && run.started)
    store_.end(plan_.activities[activity], state == ActivityState::succeeded);
  enter(activity, ActivityPhase::done, now);
  change(activity, state, reason);
}

void PlanRun::cancel(Index activity, Time now, AfterCancel after, const std::string& reason) {
  ActivityRun& run = runs_[activity];
  enter(activity, ActivityPhase::cancelling, now);
  run.after_cancel = after;
  send(activity, CommandAction::cancel);
  change(activity, run.state, reason);
}

}  // namespace roci::exec::executive
