#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"

#include <vector>

#include "core/pddl/plan_text.hpp"

namespace roci::planner::temporal_pddl::extraction {

std::string to_ipc(const Plan& plan) {
  std::vector<pddl::PlanStep> steps;
  for (const Activity& activity : plan.activities) {
    pddl::PlanStep step;
    step.start = activity.start;
    step.action.symbol = activity.name;
    for (const auto& argument : activity.arguments) step.action.arguments.push_back({argument, {}});
    if (activity.durative) step.duration = activity.end - activity.start;
    steps.push_back(std::move(step));
  }
  return pddl::print_plan(steps);
}

}  // namespace roci::planner::temporal_pddl::extraction
