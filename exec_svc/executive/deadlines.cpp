#include "exec_svc/executive/deadlines.hpp"

#include <algorithm>

namespace roci::exec::executive {

using temporal::bounded;
using temporal::Duration;
using temporal::LatenessPolicy;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;

Deadlines::Deadlines(const RunState& state) : state_(&state), tokens_from_(state.plan.activities.size()) {
  for (std::size_t t = 0; t < state.plan.tokens.size(); ++t) {
    const PointOwner& owner = state.points.owner(state.plan.tokens[t].start_point);
    if (owner.role == PointRole::start) tokens_from_[owner.activity].push_back(t);
  }
}

Time Deadlines::end(Index activity) const {
  const PlanActivity& planned = state_->plan.activities[activity];
  if (planned.lateness != LatenessPolicy::deadline) return temporal::no_bound;
  if (tokens_from_[activity].empty()) return state_->points.window(planned.end_point).upper;
  Time earliest = temporal::no_bound;
  for (const std::size_t token : tokens_from_[activity])
    earliest = std::min(earliest, state_->points.window(state_->plan.tokens[token].end_point).upper);
  return earliest;
}

bool Deadlines::leaves_room(Index activity, Time now) const {
  const bool keeps_end = state_->plan.activities[activity].lateness == LatenessPolicy::deadline;
  return plus(now, keeps_end ? state_->points.duration(activity).lower : Duration{0}) <= end(activity);
}

Time Deadlines::hung_after(Index activity) const {
  const Duration longest = state_->points.duration(activity).upper;
  if (!bounded(longest)) return temporal::no_bound;
  const ExecutiveSettings& settings = state_->settings;
  const Duration stretched = temporal::seconds(temporal::to_seconds(longest) * settings.overrun_factor);
  return plus(state_->runs[activity].attempt_started, plus(stretched, settings.overrun_grace));
}

Time Deadlines::latest_end(Index activity) const {
  const Time last = end(activity);
  return std::min(bounded(last) ? last - Duration{1} : last, hung_after(activity));
}

Time Deadlines::settled_from(Index activity) const {
  const PlanActivity& planned = state_->plan.activities[activity];
  const ActivityRun& run = state_->runs[activity];
  if (planned.lateness != LatenessPolicy::push || planned.owner.empty()) return run.phase_since;
  return std::max(run.phase_since, run.attempt_started + state_->points.duration(activity).lower);
}

Duration Deadlines::settle_time(Index activity) const {
  return state_->settings.settle_time + state_->settings.round_trip(state_->command(activity).owner);
}

Time Deadlines::next_timer(Index activity, Time now) const {
  const PlanActivity& planned = state_->plan.activities[activity];
  const ActivityRun& run = state_->runs[activity];
  const ExecutiveSettings& settings = state_->settings;
  if (run.phase == ActivityPhase::cancelling)
    return run.phase_since + settings.cancel_timeout + settings.round_trip(state_->command(activity).owner);
  if (run.phase == ActivityPhase::settling) {
    const Time from = settled_from(activity);
    return now < from ? from : from + settle_time(activity);
  }
  Time next = plus(end(activity), Duration{1});
  if (!planned.owner.empty()) next = std::min(next, hung_after(activity));
  if (run.phase == ActivityPhase::sent)
    next = std::min(next, run.phase_since + state_->command(activity).answer_within);
  if (!planned.maintenance.empty() && !run.maintenance_held)
    next = std::min(next, run.attempt_started + settle_time(activity));
  return next;
}

}  // namespace roci::exec::executive
