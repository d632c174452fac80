#include "planner_svc/temporal_pddl/cli/checked_result.hpp"

#include <malloc.h>

#include <vector>

#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"

namespace roci::planner::temporal_pddl::cli {

using temporal::Verdict;

std::string check(const pddl::Domain& domain, const pddl::Problem& problem, Result& result) {
  if (!result.plan) return {};
  malloc_trim(0);  // what the search has freed goes first, so that the check does not raise the peak
  std::string printed = extraction::to_ipc(*result.plan);
  std::vector<pddl::PlanStep> steps;
  try {
    steps = pddl::parse_plan(printed, "plan");
  } catch (const pddl::ParseError& error) {  // a time that plans cannot tell
    result.plan.reset();
    result.verdict = Verdict::unsupported;
    result.reason = "the plan that was found takes too long to be written, use a greater unit of time:\n" +
                    std::string(error.what());
    return {};
  }
  const std::string refusal = checker::refusal(domain, problem, steps, result.functions);
  if (refusal.empty()) return printed;
  result.plan.reset();
  result.verdict = Verdict::crashed;
  result.reason =
      "a plan was found that the validator refuses, so it is not printed; this is a defect of the planner, "
      "please "
      "report it with both files:\n" +
      refusal + printed;
  return {};
}

}  // namespace roci::planner::temporal_pddl::cli
