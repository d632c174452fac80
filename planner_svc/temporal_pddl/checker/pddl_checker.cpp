#include "planner_svc/temporal_pddl/checker/pddl_checker.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/pddl/check.hpp"
#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"
#include "core/temporal/schedule.hpp"
#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::checker {

using engine::CheckedPlan;
using temporal::Duration, temporal::FlexiblePlan, temporal::PlanActivity;

namespace {

bool is_durative(const pddl::Domain& domain, const std::string& name) {
  return std::ranges::find(domain.durative_actions, name, &pddl::DurativeAction::name) !=
         domain.durative_actions.end();
}

std::vector<pddl::PlanStep> steps_of(const FlexiblePlan& plan, const pddl::Domain& domain,
                                     const std::vector<Duration>& times) {
  std::vector<pddl::PlanStep> steps;
  for (const PlanActivity& activity : plan.activities) {
    pddl::PlanStep step;
    step.start = times[activity.start_point];
    step.action.symbol = activity.name;
    for (const temporal::Property& object : activity.arguments)
      step.action.arguments.push_back({object.value, {}});
    if (is_durative(domain, activity.name)) step.duration = times[activity.end_point] - step.start;
    steps.push_back(std::move(step));
  }
  return steps;
}

// Goals that activities say they serve, and that nobody asked for.
std::vector<std::string> unknown_goals(const CheckedPlan& checked) {
  std::set<std::string> asked;
  for (const engine::Goal& goal : checked.request.goals) asked.insert(goal.key());
  std::vector<std::string> faults;
  for (const PlanActivity& activity : checked.plan.activities)
    for (const std::string& goal : activity.goals_served)
      if (!asked.contains(goal))
        faults.push_back(activity.id + " serves " + goal + ", which is not asked for");
  return faults;
}

}  // namespace

std::vector<std::string> PddlChecker::faults(const CheckedPlan& checked) const {
  const FlexiblePlan& plan = checked.plan;
  if (std::vector<std::string> faults = temporal::check(plan); !faults.empty()) return faults;
  if (std::vector<std::string> faults = unknown_goals(checked); !faults.empty()) return faults;
  const auto times = temporal::earliest_schedule(plan.point_count, temporal::all_constraints(plan));
  if (!times) return {"its network has no schedule"};
  const pddl::Domain domain = pddl::load_domain(checked.request.model, "domain");
  const pddl::Problem problem = pddl::load_problem(checked.request.problem_text, "problem", domain);
  const std::vector<pddl::PlanStep> steps = steps_of(plan, domain, *times);
  const validate::Report report = validate::validate(domain, problem, steps, table_of(checked.values));
  if (report.valid) return {};
  return {validate::to_text(report, steps, "plan")};
}

}  // namespace roci::planner::temporal_pddl::checker
