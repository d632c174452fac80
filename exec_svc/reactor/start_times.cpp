#include "exec_svc/reactor/start_times.hpp"

#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "core/temporal/execution_windows.hpp"
#include "core/temporal/schedule.hpp"

namespace roci::exec::reactor {

using temporal::Duration;
using temporal::FlexiblePlan;
using temporal::PlanActivity;
using temporal::TemporalConstraint;
using temporal::TimePoint;

namespace {

// The plan's network, in which commands last their longest; nothing, where no schedule has room for that.
struct Roomy {
  std::vector<TemporalConstraint> network;
  std::vector<Duration> earliest;
};

std::optional<Roomy> with_longest_commands(const FlexiblePlan& plan) {
  Roomy out{all_constraints(plan), {}};
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    TemporalConstraint& duration = out.network[i];  // of the activity at this index
    if (!plan.activities[i].owner.empty() && temporal::bounded(duration.upper))
      duration.lower = duration.upper;
  }
  auto times = temporal::earliest_schedule(plan.point_count, out.network);
  if (!times) return std::nullopt;
  out.earliest = std::move(*times);
  return out;
}

// Returns for each point the first of those that rigid constraints hold together with it.
std::vector<TimePoint> rigid_groups(const FlexiblePlan& plan) {
  std::vector<TimePoint> group(plan.point_count);
  std::iota(group.begin(), group.end(), TimePoint{0});
  const auto first_of = [&](TimePoint point) {
    while (group[point] != point) point = group[point] = group[group[point]];
    return point;
  };
  for (const TemporalConstraint& constraint : plan.constraints)
    if (constraint.lower == constraint.upper)
      group[first_of(constraint.to_point)] = first_of(constraint.from_point);
  for (TimePoint point = 0; point < group.size(); ++point) group[point] = first_of(point);
  return group;
}

}  // namespace

void fix_starts(FlexiblePlan& plan) {
  std::vector<Duration> times;
  if (auto roomy = with_longest_commands(plan)) {
    times = std::move(roomy->earliest);
  } else if (auto plain = temporal::earliest_schedule(plan.point_count, all_constraints(plan))) {
    times = std::move(*plain);
  } else {
    return;  // a plan with no schedule is refused by whoever loads it
  }
  const std::vector<TimePoint> group = rigid_groups(plan);
  std::set<TimePoint> ends;
  for (const PlanActivity& activity : plan.activities)
    if (!activity.owner.empty()) ends.insert(group[activity.end_point]);
  for (PlanActivity& activity : plan.activities) {
    if (activity.lateness == temporal::LatenessPolicy::push)
      activity.lateness = temporal::LatenessPolicy::replan;
    if (activity.owner.empty() || ends.contains(group[activity.start_point])) continue;
    const Duration at = times[activity.start_point];
    plan.constraints.push_back(
        {temporal::origin_point, activity.start_point, temporal::ConstraintKind::window, at, at});
  }
}

void prefer_latest_starts(FlexiblePlan& plan) {
  const auto roomy = with_longest_commands(plan);
  if (!roomy) return;
  temporal::ExecutionWindows windows(plan.point_count, roomy->network, plan.origin);
  windows.settle();
  for (PlanActivity& activity : plan.activities) {
    const temporal::Time latest = windows.window(activity.start_point).upper;
    if (temporal::bounded(latest)) activity.preferred_start = latest - plan.origin;
  }
}

}  // namespace roci::exec::reactor
