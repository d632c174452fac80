// Until when activities under way may do what, and when that is to be looked at next.
#include <algorithm>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::bounded;
using temporal::Duration;
using temporal::LatenessPolicy;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;

/// Latest end under LatenessPolicy::deadline: the latest next change of the timelines that begin a token with
/// it.
Time PlanRun::deadline(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  if (planned.lateness != LatenessPolicy::deadline) return temporal::no_bound;
  if (tokens_from_[activity].empty()) return points_.window(planned.end_point).upper;
  Time earliest = temporal::no_bound;
  for (const std::size_t token : tokens_from_[activity])
    earliest = std::min(earliest, points_.window(plan_.tokens[token].end_point).upper);
  return earliest;
}

/// An activity without a longest duration is followed as long as its owner lives.
Time PlanRun::hung_after(Index activity) const {
  const Duration longest = points_.duration(activity).upper;
  if (!bounded(longest)) return temporal::no_bound;
  const Duration stretched = temporal::seconds(temporal::to_seconds(longest) * settings_.overrun_factor);
  return plus(runs_[activity].attempt_started, plus(stretched, settings_.overrun_grace));
}

/// From when on a completed command counts as a success, if its post condition holds (R86).
Time PlanRun::settled_from(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  if (planned.lateness != LatenessPolicy::push || planned.owner.empty()) return run.phase_since;
  return std::max(run.phase_since, run.attempt_started + points_.duration(activity).lower);
}

Time PlanRun::next_timer(Index activity, Time now) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  if (run.phase == ActivityPhase::cancelling) return run.phase_since + settings_.cancel_timeout;
  if (run.phase == ActivityPhase::contingency) return contingency_timer(activity);
  if (run.phase == ActivityPhase::settling) {
    const Time from = settled_from(activity);
    return now < from ? from : from + settings_.settle_time;
  }
  Time next = plus(deadline(activity), Duration{1});
  if (!planned.owner.empty()) next = std::min(next, hung_after(activity));
  if (run.phase == ActivityPhase::sent) next = std::min(next, run.phase_since + settings_.ack_timeout);
  if (!planned.maintenance.empty() && !run.maintenance_held)
    next = std::min(next, run.attempt_started + settings_.settle_time);
  return next;
}

}  // namespace roci::exec::executive
