#include "planner_svc/temporal_pddl/cli/checked_result.hpp"

#include <malloc.h>

#include <optional>
#include <string>

#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"

namespace roci::planner::temporal_pddl::cli {

using engine::FunctionOutcome, engine::FunctionUse;
using temporal::Verdict;

namespace {

pddl::FunctionTable table_of(const std::vector<FunctionUse>& uses) {
  pddl::FunctionTable table;
  for (const FunctionUse& use : uses) {
    std::string application = "(" + use.call.function;
    for (const std::string& argument : use.call.arguments) application += " " + argument;
    const bool has_value = use.answer.outcome == FunctionOutcome::value;
    table[application + ")"] = has_value ? std::optional(use.answer.value) : std::nullopt;
  }
  return table;
}

}  // namespace

void check(const pddl::Domain& domain, const pddl::Problem& problem, Result& result) {
  if (!result.plan) return;
  malloc_trim(0);  // what the search has freed goes first, so that the check does not raise the peak
  const std::string printed = to_ipc(*result.plan);
  const std::string refusal =
      checker::refusal(domain, problem, pddl::parse_plan(printed, "plan"), table_of(result.functions));
  if (refusal.empty()) return;
  result.plan.reset();
  result.verdict = Verdict::crashed;
  result.reason =
      "a plan was found that the validator refuses, so it is not printed; this is a defect of the planner, "
      "please "
      "report it with both files:\n" +
      refusal + printed;
}

}  // namespace roci::planner::temporal_pddl::cli
