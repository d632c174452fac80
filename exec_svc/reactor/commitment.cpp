#include "exec_svc/reactor/commitment.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/temporal/execution_windows.hpp"

namespace roci::exec::reactor {

using executive::StepStatus;

namespace {

using temporal::CommitState;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

using ById = std::unordered_map<std::string, const PlanActivity*>;

ById by_id(const temporal::FlexiblePlan& plan) {
  ById out;
  for (const PlanActivity& activity : plan.activities) out.emplace(activity.id, &activity);
  return out;
}

bool same_but_for_commit(PlanActivity a, const PlanActivity& b) {
  a.commit = b.commit;
  return a == b;
}

std::string change_of(const PlanActivity& activity, const StepStatus& step, const ById& next) {
  const auto found = next.find(activity.id);
  const bool stands = found != next.end();
  const bool begun = step.state != temporal::ActivityState::waiting;
  const bool bound = (begun || activity.commit == CommitState::committed) && !is_over(step.state);
  const bool ended_badly = is_over(step.state) && step.state != temporal::ActivityState::succeeded;
  if (stands && ended_badly) return activity.id + " has ended without success and stands in it";
  const std::string what = activity.id + (begun ? ", which has begun, " : ", which is committed, ");
  if (bound && !stands) return what + "is missing";
  if (stands && (bound || begun) && !same_but_for_commit(*found->second, activity))
    return what + "has changed";
  if (bound && found->second->commit != CommitState::committed) return what + "is no longer committed";
  return "";
}

std::string lateness_of(const std::vector<StepStatus>& steps, const temporal::FlexiblePlan& next,
                        const ById& activities, Time now) {
  std::vector<std::pair<Time, TimePoint>> events;
  for (const StepStatus& step : steps) {
    const auto found = activities.find(step.activity);
    if (found == activities.end()) continue;
    if (step.started) events.emplace_back(*step.started, found->second->start_point);
    if (step.ended) events.emplace_back(*step.ended, found->second->end_point);
  }
  std::sort(events.begin(), events.end());
  temporal::ExecutionWindows windows(next.point_count, all_constraints(next), next.origin);
  for (const auto& [at, point] : events) windows.happen(point, at);
  windows.settle();
  for (const PlanActivity& activity : next.activities) {
    if (activity.commit != CommitState::committed || windows.happened(activity.start_point)) continue;
    if (activity.lateness == temporal::LatenessPolicy::push) continue;
    const temporal::Window start = windows.window(activity.start_point);
    if (start.upper < std::max(now, start.lower))
      return activity.id + " would have to start before " + temporal::to_text(start.upper);
  }
  return "";
}

}  // namespace

std::string commitment_violation(const temporal::FlexiblePlan& running, const std::vector<StepStatus>& steps,
                                 const temporal::FlexiblePlan& next, Time now) {
  const ById before = by_id(running);
  const ById after = by_id(next);
  for (const StepStatus& step : steps)
    if (std::string change = change_of(*before.at(step.activity), step, after); !change.empty())
      return change;
  return lateness_of(steps, next, after, now);
}

}  // namespace roci::exec::reactor
