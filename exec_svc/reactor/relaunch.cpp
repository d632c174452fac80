#include "exec_svc/reactor/relaunch.hpp"

#include <algorithm>
#include <utility>

#include "core/temporal/execution_windows.hpp"

namespace roci::exec::reactor {

using executive::StepStatus;
using temporal::ActivityState;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

std::set<std::string> left_out(const std::vector<StepStatus>& steps, const std::set<std::string>& dropped) {
  std::set<std::string> out = dropped;
  for (const StepStatus& step : steps)
    if (step.state == ActivityState::skipped) out.insert(step.activity);
  return out;
}

std::string relaunch_fault(const temporal::FlexiblePlan& plan, const std::vector<StepStatus>& steps,
                           const std::set<std::string>& without, Time now) {
  std::vector<std::pair<Time, TimePoint>> events;
  std::vector<const PlanActivity*> to_do;
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const PlanActivity& activity = plan.activities[i];
    if (without.contains(activity.id)) continue;
    if (steps[i].state == ActivityState::succeeded) {
      events.emplace_back(*steps[i].started, activity.start_point);
      events.emplace_back(*steps[i].ended, activity.end_point);
    } else if (activity.owner.empty() && steps[i].started) {  // it goes on
      events.emplace_back(*steps[i].started, activity.start_point);
    } else {
      to_do.push_back(&activity);
    }
  }
  if (to_do.empty()) return "nothing of the plan is left to be done";
  std::sort(events.begin(), events.end());
  temporal::ExecutionWindows windows(plan.point_count, all_constraints(plan), plan.origin);
  for (const auto& [at, point] : events) windows.happen(point, at);
  for (const PlanActivity& activity : plan.activities) {
    if (!without.contains(activity.id)) continue;
    windows.drop(activity.start_point);
    windows.drop(activity.end_point);
  }
  windows.settle();
  for (const PlanActivity* activity : to_do) {
    if (activity->lateness == temporal::LatenessPolicy::push) continue;
    const temporal::Window start = windows.window(activity->start_point);
    if (start.upper < now)
      return activity->id + " would have had to start before " + temporal::to_text(start.upper) +
             "; drop it, or let the robot plan anew (autonomy E4)";
  }
  return "";
}

}  // namespace roci::exec::reactor
