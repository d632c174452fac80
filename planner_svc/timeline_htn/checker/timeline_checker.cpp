#include "planner_svc/timeline_htn/checker/timeline_checker.hpp"

#include "planner_svc/timeline_htn/checking/check.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/request/problem_of.hpp"

namespace roci::planner::timeline_htn::checker {

std::vector<std::string> TimelineChecker::faults(const engine::CheckedPlan& checked) const {
  mission::Findings findings;
  auto model = request::read_model(checked.request, findings);
  if (!model) return {"the model of the request cannot be read"};
  std::vector<std::string> out;
  for (const request::Misfit& misfit : request::put_request(checked.request, *model))
    out.push_back(misfit.what);
  if (out.empty() && !model::usable(model::check(*model)))
    out.push_back("the problem of the request contradicts itself");
  return out.empty() ? checking::faults(*model, checked.plan) : out;
}

}  // namespace roci::planner::timeline_htn::checker
