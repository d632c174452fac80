#include "planner_svc/temporal_pddl/cli/checked_result.hpp"

#include <malloc.h>

#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"

namespace roci::planner::temporal_pddl::cli {

using temporal::Verdict;

std::string check(const pddl::Domain& domain, const pddl::Problem& problem, Result& result) {
  if (!result.plan) return {};
  malloc_trim(0);  // what the search has freed goes first, so that the check does not raise the peak
  std::string printed = extraction::to_ipc(*result.plan);
  const std::string refusal =
      checker::refusal(domain, problem, pddl::parse_plan(printed, "plan"), result.functions);
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
