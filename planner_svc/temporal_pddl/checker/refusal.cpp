#include "planner_svc/temporal_pddl/checker/refusal.hpp"

#include <optional>

#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::checker {

using engine::FunctionOutcome, engine::FunctionUse;

pddl::FunctionTable table_of(std::span<const FunctionUse> uses) {
  pddl::FunctionTable table;
  for (const FunctionUse& use : uses) {
    const bool has_value = use.answer.outcome == FunctionOutcome::value;
    if (has_value && !use.answer.is_exact()) continue;  // no plan may stand on it
    table[application(use.call)] = has_value ? std::optional(use.answer.value) : std::nullopt;
  }
  return table;
}

std::string refusal(const pddl::Domain& domain, const pddl::Problem& problem,
                    const std::vector<pddl::PlanStep>& steps, std::span<const FunctionUse> functions) {
  const validate::Report report = validate::validate(domain, problem, steps, table_of(functions));
  return report.valid ? std::string() : validate::to_text(report, steps, "plan");
}

}  // namespace roci::planner::temporal_pddl::checker
