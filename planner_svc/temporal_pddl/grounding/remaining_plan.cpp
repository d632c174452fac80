#include "planner_svc/temporal_pddl/grounding/remaining_plan.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "core/pddl/printer.hpp"

namespace roci::planner::temporal_pddl::grounding {

using task::Action, task::ActionId, task::SnapId, task::Task;
using temporal::Duration;

std::vector<SnapId> ground_remaining_plan(const Task& task, std::span<const pddl::PlanStep> remaining) {
  std::unordered_map<std::string, ActionId> known;
  for (std::size_t i = 0; i < task.actions.size(); ++i) known.emplace(name(task, ActionId(i)), ActionId(i));
  struct Event {
    Duration time;
    bool starts;
    SnapId snap;
  };
  std::vector<Event> events;
  for (const pddl::PlanStep& step : remaining) {
    const auto found = known.find(pddl::print(step.action));
    if (found == known.end()) continue;
    const Action& action = task.actions[found->second];
    events.push_back({step.start, true, action.start});
    if (!action.instantaneous())
      events.push_back({step.start + step.duration.value_or(Duration{0}), false, action.end});
  }
  std::ranges::stable_sort(events, [](const Event& a, const Event& b) {
    return a.time != b.time ? a.time < b.time : a.starts < b.starts;
  });
  std::vector<SnapId> snaps;
  for (const Event& event : events) snaps.push_back(event.snap);
  return snaps;
}

}  // namespace roci::planner::temporal_pddl::grounding
