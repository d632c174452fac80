#include "tests/unit/exec_svc/executive/plan_builder.hpp"

#include <algorithm>
#include <stdexcept>

namespace roci::exec::testing {

using temporal::ConstraintKind;
using temporal::seconds;
using temporal::TimePoint;

temporal::PlanActivity& PlanBuilder::activity(const std::string& id, const std::string& owner,
                                              double shortest, double longest) {
  temporal::PlanActivity& activity = plan.activities.emplace_back();
  activity.id = activity.name = id;
  activity.owner = owner;
  if (!owner.empty()) activity.command_name = "do-" + id;
  activity.start_point = point();
  activity.end_point = point();
  activity.duration_lower = seconds(shortest);
  activity.duration_upper = longest < 0 ? temporal::no_bound : seconds(longest);
  return activity;
}

void PlanBuilder::after(const std::string& earlier, const std::string& later, double gap) {
  plan.constraints.push_back(
      {end(earlier), start(later), ConstraintKind::ordering, seconds(gap), temporal::no_bound});
}

void PlanBuilder::between(TimePoint from, TimePoint to, double lower, double upper) {
  plan.constraints.push_back(
      {from, to, ConstraintKind::ordering, seconds(lower), upper < 0 ? temporal::no_bound : seconds(upper)});
}

void PlanBuilder::window(TimePoint point, double lower, double upper) {
  plan.constraints.push_back({temporal::origin_point, point, ConstraintKind::window, seconds(lower),
                              upper < 0 ? temporal::no_bound : seconds(upper)});
}

void PlanBuilder::token(const std::string& timeline, temporal::Value held, TimePoint from, TimePoint to) {
  plan.tokens.push_back({timeline, std::move(held), from, to});
}

const temporal::PlanActivity& PlanBuilder::find(const std::string& id) const {
  const auto found = std::find_if(plan.activities.begin(), plan.activities.end(),
                                  [&](const temporal::PlanActivity& activity) { return activity.id == id; });
  if (found == plan.activities.end()) throw std::invalid_argument("no activity " + id);
  return *found;
}

}  // namespace roci::exec::testing
