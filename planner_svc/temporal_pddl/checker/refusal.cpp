#include "planner_svc/temporal_pddl/checker/refusal.hpp"

#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::checker {

std::string refusal(const pddl::Domain& domain, const pddl::Problem& problem,
                    const std::vector<pddl::PlanStep>& steps, const pddl::FunctionTable& functions) {
  const validate::Report report = validate::validate(domain, problem, steps, functions);
  return report.valid ? std::string() : validate::to_text(report, steps, "plan");
}

}  // namespace roci::planner::temporal_pddl::checker
