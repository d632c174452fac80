#include "exec_svc/reactor/remaining_plan.hpp"

#include <set>
#include <string_view>

#include "core/temporal/schedule.hpp"

namespace roci::exec::reactor {

using executive::StepStatus;

namespace {

using temporal::ActivityState;

bool begun(ActivityState state) {
  switch (state) {
    case ActivityState::dispatched:
    case ActivityState::running:
    case ActivityState::succeeded:
    case ActivityState::skipped:
      return true;
    case ActivityState::waiting:
    case ActivityState::failed:
    case ActivityState::cancelled:
      return false;
  }
  return false;
}

}  // namespace

std::vector<PlannedAction> planned_actions(const temporal::FlexiblePlan& plan) {
  const auto times = temporal::earliest_schedule(plan.point_count, temporal::all_constraints(plan));
  if (!times) return {};
  std::vector<PlannedAction> out;
  for (const temporal::PlanActivity& activity : plan.activities) {
    const temporal::Duration start = (*times)[activity.start_point];
    PlannedAction action{{}, activity.name, {}, start, (*times)[activity.end_point] - start};
    for (const temporal::Property& argument : activity.arguments) action.arguments.push_back(argument.value);
    out.push_back(std::move(action));
  }
  return out;
}

std::vector<PlannedAction> remaining_actions(std::vector<PlannedAction> planned,
                                             const std::vector<StepStatus>& steps) {
  std::set<std::string_view> gone;
  for (const StepStatus& step : steps)
    if (begun(step.state)) gone.insert(step.activity);
  std::erase_if(planned, [&](const PlannedAction& action) { return gone.contains(action.activity); });
  return planned;
}

}  // namespace roci::exec::reactor
