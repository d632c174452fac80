#include "exec_svc/reactor/relaunch.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/temporal/execution_windows.hpp"

namespace roci::exec::reactor {

using executive::StepStatus;
using temporal::ActivityState;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

std::set<std::string> left_out(const temporal::FlexiblePlan& plan, const std::vector<StepStatus>& steps,
                               const std::set<std::string>& dropped) {
  std::map<std::string, std::vector<std::size_t>> parts;  // by what they are parts of
  std::map<std::string, std::string> whole;               // by part
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const PlanActivity& activity = plan.activities[i];
    if (activity.parent.empty()) continue;
    parts[activity.parent].push_back(i);
    whole[activity.id] = activity.parent;
  }
  std::vector<std::string> open(dropped.begin(),
                                dropped.end());  // whose parts and wholes are still to be seen to
  std::set<std::string> out = dropped;
  for (const StepStatus& step : steps)
    if (step.state == ActivityState::skipped) out.insert(step.activity);
  const auto leave_out = [&](const std::string& activity) {
    if (out.insert(activity).second) open.push_back(activity);
  };
  const auto is_out = [&](std::size_t part) { return out.contains(plan.activities[part].id); };
  while (!open.empty()) {
    const std::string activity = open.back();
    open.pop_back();
    for (const std::size_t part : parts[activity])
      if (steps[part].state != ActivityState::succeeded) leave_out(plan.activities[part].id);
    if (const auto above = whole.find(activity); above != whole.end())
      if (std::ranges::all_of(parts[above->second], is_out)) leave_out(above->second);
  }
  return out;
}

std::string drop_fault(const temporal::FlexiblePlan& plan, const std::vector<StepStatus>& steps,
                       const std::set<std::string>& dropped) {
  const std::set<std::string> without = left_out(plan, steps, dropped);
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const PlanActivity& activity = plan.activities[i];
    if (activity.owner.empty() && steps[i].started && steps[i].state != ActivityState::skipped &&
        without.contains(activity.id))
      return "nothing of " + activity.id +
             " would be left, which has begun; let the robot plan anew (autonomy E4), or recall its goal";
  }
  return "";
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
