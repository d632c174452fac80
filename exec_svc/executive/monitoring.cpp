// Activities under way: conditions and timers.
#include <vector>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::PlanActivity;
using temporal::Time;
using temporal::to_text;
using temporal::Truth;

bool PlanRun::monitor(Time now) {
  bool progress = false;
  const std::vector<Index> active(active_.begin(), active_.end());
  for (const Index activity : active)
    if (runs_[activity].active()) progress = monitor_activity(activity, now) || progress;
  return progress;
}

bool PlanRun::monitor_activity(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  const Time age = now - run.phase_since;
  const bool commanded = !planned.owner.empty();
  if (run.phase == ActivityPhase::contingency) return monitor_contingency(activity, now);
  if (run.phase == ActivityPhase::cancelling) {
    if (age < settings_.cancel_timeout) return false;
    cancel_is_over(activity, now, "cancel not answered within " + to_text(settings_.cancel_timeout));
    return true;
  }
  if (run.phase == ActivityPhase::sent && age >= settings_.ack_timeout) {
    const std::string reason =
        "command not answered by " + planned.owner + " within " + to_text(settings_.ack_timeout);
    if (run.retries_used < planned.retries && starting()) {
      cancel(activity, now, AfterCancel::retry, reason);
    } else {
      fail(activity, now, Breakage::activity_failed, reason, true);
    }
    return true;
  }
  if (check_maintenance(activity, now)) return true;
  if (run.phase == ActivityPhase::settling) return try_finish(activity, now);
  if (now > deadline(activity)) {
    fail(activity, now, Breakage::deadline_passed,
         "still running at its deadline " + to_text(deadline(activity)), commanded);
    return true;
  }
  if (commanded && now >= hung_after(activity)) {
    fail(activity, now, Breakage::activity_failed, "no end long after its longest duration", true);
    return true;
  }
  return false;
}

/// True if it failed. A condition that its own start brings about is given the settle time to become true.
bool PlanRun::check_maintenance(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (planned.maintenance.empty() || run.phase == ActivityPhase::settling) return false;
  const Truth truth = evaluate(planned.maintenance, lookup());
  if (truth == Truth::yes) run.maintenance_held = true;
  const bool demanded = run.maintenance_held || now >= run.attempt_started + settings_.settle_time;
  if (truth != Truth::no || !demanded) return false;
  fail(activity, now, Breakage::activity_failed,
       "maintenance condition broken: " + explain(planned.maintenance, lookup()), !planned.owner.empty());
  return true;
}

bool PlanRun::try_finish(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  const Time from = settled_from(activity);
  if (now < from) return false;
  if (evaluate(planned.post, lookup()) == Truth::yes) {
    if (planned.owner.empty()) return false;  // its end point is ready: the dispatch ends it
    succeed(activity, now);
    return true;
  }
  if (now < from + settings_.settle_time) return false;
  fail(activity, now, Breakage::activity_failed,
       "post condition does not hold: " + explain(planned.post, lookup()), false);
  return true;
}

}  // namespace roci::exec::executive
