#include "tests/engines/answering/search_checker.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tests/engines/checking/sequence_check.hpp"

namespace roci::planner::proof {

using engine::CheckedPlan, engine::Goal;
using temporal::PlanActivity;

namespace {

using Names = std::set<std::string>;

// For each activity the goals that hang on it: what set last what a goal, or an activity of a goal, needs.
std::vector<Names> served(const TaskModel& model, const CheckedPlan& checked,
                          const std::vector<std::size_t>& order) {
  std::vector<Names> out(checked.plan.activities.size());
  std::map<std::string, std::size_t> setter;
  std::vector<std::set<std::size_t>> behind(
      out.size());  // activities that each one hangs on, itself included
  for (const std::size_t index : order) {
    const Task* task = model.task(checked.plan.activities[index].name);
    behind[index].insert(index);
    if (task == nullptr) continue;
    for (const Held& held : task->needs)
      if (const auto found = setter.find(held.timeline); found != setter.end())
        behind[index].insert(behind[found->second].begin(), behind[found->second].end());
    for (const Held& held : task->sets) setter[held.timeline] = index;
  }
  for (const Goal& goal : checked.request.goals)
    for (const std::string& timeline : temporal::timelines_of(goal.achieved))
      if (const auto found = setter.find(timeline); found != setter.end())
        for (const std::size_t index : behind[found->second]) out[index].insert(goal.key());
  return out;
}

}  // namespace

std::vector<std::string> SearchChecker::faults(const CheckedPlan& checked) const {
  const TaskModel model = read_model(checked.request.model);
  SequenceReport report = check_sequence(model, checked);
  std::vector<std::string> faults = std::move(report.faults);
  if (checked.plan.origin != checked.request.origin) faults.push_back("it begins at another time than asked");
  for (const Goal& goal : checked.request.goals) {
    if (!satisfied(goal.achieved, report.final_state)) faults.push_back("it does not achieve " + goal.key());
    if (!temporal::bounded(goal.closes) || report.order.empty()) continue;
    const PlanActivity& last = checked.plan.activities[report.order.back()];
    const bool in_time = std::ranges::any_of(checked.plan.constraints, [&](const auto& constraint) {
      return constraint.from_point == temporal::origin_point && constraint.to_point == last.end_point &&
             constraint.upper <= goal.closes - checked.request.origin;
    });
    if (!in_time) faults.push_back("it may be too late for " + goal.key());
  }
  const std::vector<Names> wanted = served(model, checked, report.order);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const PlanActivity& activity = checked.plan.activities[i];
    if (Names(activity.goals_served.begin(), activity.goals_served.end()) != wanted[i])
      faults.push_back(activity.id + " does not serve the goals that it says");
  }
  if (checked.plan.function_values.size() != checked.values.size())
    faults.push_back("it does not say on which values it stands");
  return faults;
}

}  // namespace roci::planner::proof
