#include "exec_svc/reactor/recovery_policy.hpp"

namespace roci::exec::reactor {

using executive::ExecutiveSettings;
using mission::MissionModel;
using mission::RecoveryStrategy;

RecoveryPolicy recovery_policy_of(RecoveryStrategy strategy) {
  switch (strategy) {
    case RecoveryStrategy::cascade:
      return {true, true, true};
    case RecoveryStrategy::as_planned:
      return {false, false, false};
    case RecoveryStrategy::ground:
      return {false, false, true};
    case RecoveryStrategy::flexible:
      return {true, false, true};
    case RecoveryStrategy::replan:
      return {false, true, true};
  }
  return {};
}

void make_inflexible(temporal::FlexiblePlan& plan) {
  for (temporal::PlanActivity& activity : plan.activities) {
    if (activity.lateness == temporal::LatenessPolicy::push)
      activity.lateness = temporal::LatenessPolicy::replan;
    activity.retries = 0;
    activity.contingency.clear();
  }
}

ExecutiveSettings executive_settings(const MissionModel& mission) {
  ExecutiveSettings settings;
  settings.ack_timeout = mission.executive.ack_timeout;
  settings.cancel_timeout = mission.executive.ack_timeout;
  settings.round_trips = mission.executive.round_trips;
  settings.start = mission.executive.start;
  settings.only_committed = mission.executive.plans_continuously();
  settings.contingencies = mission.contingencies;
  for (const auto& [name, binding] : mission.actions)
    if (temporal::bounded(binding.retry_within)) settings.retry_within[name] = binding.retry_within;
  return settings;
}

}  // namespace roci::exec::reactor
