#include "exec_svc/executive/activity_monitor.hpp"

#include <vector>

namespace roci::exec::executive {

using temporal::LatenessPolicy;
using temporal::PlanActivity;
using temporal::Time;
using temporal::to_text;
using temporal::Truth;

bool ActivityMonitor::check(Time now) {
  bool progress = false;
  const std::vector<Index> active(state_->active.begin(), state_->active.end());
  for (const Index activity : active)
    if (state_->runs[activity].active()) progress = check_activity(activity, now) || progress;
  return progress;
}

bool ActivityMonitor::check_activity(Index activity, Time now) {
  const ActivityRun& run = state_->runs[activity];
  if (run.phase == ActivityPhase::contingency) return check_contingency(activity, now);
  if (run.phase == ActivityPhase::cancelling || run.phase == ActivityPhase::sent) {
    if (check_command(activity, now)) return true;
    if (run.phase == ActivityPhase::cancelling) return false;
  }
  if (check_maintenance(activity, now)) return true;
  if (run.phase == ActivityPhase::settling) return try_finish(activity, now);
  const bool commanded = !state_->plan.activities[activity].owner.empty();
  if (const Time end = deadlines_->end(activity); now > end) {
    attempts_->fail(activity, now, Breakage::deadline_passed, "still running at its deadline " + to_text(end),
                    commanded);
    return true;
  }
  if (commanded && now >= deadlines_->hung_after(activity)) {
    attempts_->fail(activity, now, Breakage::activity_failed, "no end long after its longest duration", true);
    return true;
  }
  return false;
}

bool ActivityMonitor::check_contingency(Index activity, Time now) {
  const auto end = contingencies_->check(activity, now);
  if (end) attempts_->resume_after(*end, now);
  return end.has_value();
}

/// Looks for a command or a cancel that was not answered in time.
bool ActivityMonitor::check_command(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  const ActivityRun& run = state_->runs[activity];
  const ExecutiveSettings& settings = state_->settings;
  const CommandOf command = state_->command(activity);
  const Time age = now - run.phase_since;
  const bool cancelling = run.phase == ActivityPhase::cancelling;
  const temporal::Duration cancel_within = settings.cancel_timeout + settings.round_trip(command.owner);
  if (age < (cancelling ? cancel_within : command.answer_within)) return false;
  if (exchange_->ask_again(activity, now)) return true;
  if (cancelling) {
    exchange_->give_cancel_up(activity, now, "cancel not answered within " + to_text(cancel_within));
    return true;
  }
  const std::string reason =
      "command not answered by " + command.owner + " within " + to_text(command.answer_within);
  if (run.retries_used < planned.retries && state_->starting()) {
    attempts_->cancel(activity, now, AfterCancel::retry, reason);
  } else {
    attempts_->fail(activity, now, Breakage::activity_failed, reason, true);
  }
  return true;
}

/// Returns whether it failed. A condition that its own start brings about is given the settle time to become
/// true.
bool ActivityMonitor::check_maintenance(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  ActivityRun& run = state_->runs[activity];
  if (planned.maintenance.empty() || run.phase == ActivityPhase::settling) return false;
  const Truth truth = evaluate(planned.maintenance, state_->lookup());
  if (truth == Truth::yes) run.maintenance_held = true;
  const bool demanded =
      run.maintenance_held || now >= run.attempt_started + deadlines_->settle_time(activity);
  if (truth != Truth::no || !demanded) return false;
  attempts_->fail(activity, now, Breakage::activity_failed,
                  "maintenance condition broken: " + explain(planned.maintenance, state_->lookup()),
                  !planned.owner.empty());
  return true;
}

bool ActivityMonitor::try_finish(Index activity, Time now) {
  const PlanActivity& planned = state_->plan.activities[activity];
  const Time from = deadlines_->settled_from(activity);
  if (now < from) return false;
  if (evaluate(planned.post, state_->lookup()) == Truth::yes) {
    if (planned.owner.empty()) return false;  // its end point is ready: the dispatch ends it
    attempts_->succeed(activity, now);
    return true;
  }
  if (now < from + deadlines_->settle_time(activity)) return false;
  attempts_->fail(activity, now, Breakage::activity_failed,
                  "post condition does not hold: " + explain(planned.post, state_->lookup()), false);
  return true;
}

void ActivityMonitor::note_overruns(Time now) {
  for (const Index i : state_->active) {
    ActivityRun& run = state_->runs[i];
    const temporal::Window planned = state_->points.duration(i);
    if (run.overrun_noted || now <= temporal::plus(run.attempt_started, planned.upper)) continue;
    if (state_->plan.activities[i].lateness == LatenessPolicy::deadline) continue;
    run.overrun_noted = true;
    state_->points.set_duration(i, run.attempt_started - *run.started + planned.lower, temporal::no_bound);
  }
}

Time ActivityMonitor::next_timer(Index activity, Time now) const {
  const bool contingency = state_->runs[activity].phase == ActivityPhase::contingency;
  return contingency ? contingencies_->timer(activity) : deadlines_->next_timer(activity, now);
}

}  // namespace roci::exec::executive
