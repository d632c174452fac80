#include "exec_svc/reactor/executed_plan.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::reactor {

using executive::CommandStage;

void ExecutionRecord::begin(const temporal::FlexiblePlan& plan) {
  const ExecutedPlan before = std::exchange(plan_, {plan.id, plan.version, plan.origin, {}, {}, {}});
  const auto known = std::exchange(index_, {});
  open_ = true;
  plan_.activities.reserve(plan.activities.size());
  for (const temporal::PlanActivity& activity : plan.activities) {
    index_[activity.id] = plan_.activities.size();
    const auto same = known.find(activity.id);
    plan_.activities.push_back(same == known.end() ? ExecutedActivity{} : before.activities[same->second]);
    ExecutedActivity& now = plan_.activities.back();
    now.id = activity.id;
    now.name = activity.name;
    now.level = activity.level;
    now.parent = activity.parent;
    now.robot = activity.robot;
  }
}

void ExecutionRecord::note(const executive::StepStatus& step) {
  const auto found = index_.find(step.activity);
  if (!open_ || found == index_.end()) return;
  ExecutedActivity& activity = plan_.activities[found->second];
  activity.state = step.state;
  activity.started = step.started;
  activity.ended = step.ended;
  activity.attempts = std::max(activity.attempts, step.attempt);
  activity.cause = step.reason;
}

void ExecutionRecord::note(const executive::CommandAck& ack) {
  const bool last = ack.stage == CommandStage::completed || ack.stage == CommandStage::failed ||
                    ack.stage == CommandStage::cancelled;
  const auto found = index_.find(ack.activity);
  if (!open_ || !last || found == index_.end()) return;
  executive::CommandResults& results = plan_.activities[found->second].results;
  if (ack.results.duration)
    results.duration = results.duration.value_or(temporal::Duration{0}) + *ack.results.duration;
  if (ack.results.energy_j) results.energy_j = results.energy_j.value_or(0) + *ack.results.energy_j;
  for (const auto& [name, value] : ack.results.values) results.values.insert_or_assign(name, value);
}

ExecutedPlan ExecutionRecord::close(ExecutedOutcome outcome, std::string reason) {
  open_ = false;
  plan_.outcome = outcome;
  plan_.reason = std::move(reason);
  index_.clear();
  return std::exchange(plan_, {});
}

}  // namespace roci::exec::reactor
