#include "tests/engines/mutations.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::proof {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::TemporalConstraint;

namespace {

// The activity goes, and those around it stay in their order.
void remove(FlexiblePlan& plan, std::size_t index) {
  const PlanActivity gone = plan.activities[index];
  temporal::TimePoint before = temporal::origin_point;
  for (const TemporalConstraint& constraint : plan.constraints)
    if (constraint.to_point == gone.start_point && constraint.from_point != temporal::origin_point)
      before = constraint.from_point;
  std::erase_if(plan.constraints, [&](const TemporalConstraint& constraint) {
    return constraint.to_point == gone.start_point || constraint.to_point == gone.end_point;
  });
  for (TemporalConstraint& constraint : plan.constraints)
    if (constraint.from_point == gone.end_point) constraint.from_point = before;
  plan.activities.erase(plan.activities.begin() + static_cast<std::ptrdiff_t>(index));
}

TemporalConstraint& ordering(FlexiblePlan& plan, std::size_t number) {
  std::size_t found = 0;
  for (TemporalConstraint& constraint : plan.constraints)
    if (constraint.kind == temporal::ConstraintKind::ordering && found++ == number) return constraint;
  return plan.constraints.back();
}

PlanActivity& drawing(FlexiblePlan& plan) {
  return *std::ranges::find_if(plan.activities, [](const PlanActivity& activity) {
    return std::ranges::any_of(activity.impacts, [](const temporal::Impact& impact) {
      return impact.kind == temporal::ImpactKind::delta;
    });
  });
}

// What is done, at the places of two activities.
void swap_tasks(FlexiblePlan& plan, std::size_t a, std::size_t b) {
  PlanActivity& first = plan.activities[a];
  PlanActivity& second = plan.activities[b];
  std::swap(first, second);
  std::swap(first.start_point, second.start_point);
  std::swap(first.end_point, second.end_point);
}

}  // namespace

const std::vector<Mutation>& mutations() {
  static const std::vector<Mutation> all = {
      {"the first activity is missing", [](FlexiblePlan& plan) { remove(plan, 0); }},
      {"the last activity is missing", [](FlexiblePlan& plan) { remove(plan, plan.activities.size() - 1); }},
      {"one in the middle is missing", [](FlexiblePlan& plan) { remove(plan, 2); }},
      {"two change places", [](FlexiblePlan& plan) { swap_tasks(plan, 1, 2); }},
      {"an order is missing",
       [](FlexiblePlan& plan) {
         const TemporalConstraint gone = ordering(plan, 0);
         std::erase(plan.constraints, gone);
       }},
      {"an order allows an overlap",
       [](FlexiblePlan& plan) { ordering(plan, 1).lower = temporal::seconds(-5); }},
      {"an order is turned round",
       [](FlexiblePlan& plan) {
         TemporalConstraint& turned = ordering(plan, 1);
         std::swap(turned.from_point, turned.to_point);
       }},
      {"an id stands twice", [](FlexiblePlan& plan) { plan.activities[1].id = plan.activities[0].id; }},
      {"an unknown task", [](FlexiblePlan& plan) { plan.activities[1].name = "fly"; }},
      {"another owner", [](FlexiblePlan& plan) { plan.activities[0].owner = "harbour_svc"; }},
      {"another robot", [](FlexiblePlan& plan) { plan.activities[3].robot = "tug"; }},
      {"another subsystem", [](FlexiblePlan& plan) { plan.activities[2].subsystem = "winch-2"; }},
      {"another command", [](FlexiblePlan& plan) { plan.activities[0].command_name = "blow-up"; }},
      {"a second command",
       [](FlexiblePlan& plan) {
         plan.activities[0].then.push_back({"lock_svc", "", "gates", "wave", {}, temporal::no_bound});
       }},
      {"an argument",
       [](FlexiblePlan& plan) {
         plan.activities[1].arguments.push_back({"speed", "9"});
       }},
      {"too short", [](FlexiblePlan& plan) { plan.activities[1].duration_lower -= temporal::seconds(1); }},
      {"without end", [](FlexiblePlan& plan) { plan.activities[1].duration_upper = temporal::no_bound; }},
      {"no condition", [](FlexiblePlan& plan) { plan.activities[0].pre = {}; }},
      {"another condition meanwhile",
       [](FlexiblePlan& plan) {
         plan.activities[1].maintenance.nodes.back().operand = temporal::state("ajar");
       }},
      {"may be skipped", [](FlexiblePlan& plan) { plan.activities[2].may_skip = true; }},
      {"no effect", [](FlexiblePlan& plan) { plan.activities[2].impacts.clear(); }},
      {"another effect",
       [](FlexiblePlan& plan) { plan.activities[0].impacts.back().amount = temporal::state("ajar"); }},
      {"draws less", [](FlexiblePlan& plan) { drawing(plan).impacts.front().amount = -1.0; }},
      {"for no goal", [](FlexiblePlan& plan) { plan.activities[0].goals_served.clear(); }},
      {"for an unknown goal",
       [](FlexiblePlan& plan) { plan.activities[1].goals_served = {"ground/treasure"}; }},
      {"of another engine", [](FlexiblePlan& plan) { plan.engine = "crystal_ball"; }},
      {"at another time", [](FlexiblePlan& plan) { plan.origin += temporal::seconds(1); }},
      {"a decision that nobody asked for",
       [](FlexiblePlan& plan) {
         plan.decisions.push_back({"which", "", {{"only", {plan.activities[0].id}, {}}}, 1});
       }},
  };
  return all;
}

}  // namespace roci::planner::proof
