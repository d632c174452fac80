#include <algorithm>

#include "services/wire/plan_wire.hpp"
#include "tests/scenario/scripted_world/script.hpp"

namespace roci::scenario {

using temporal::ConstraintKind;
using temporal::PlanActivity;

ScriptedEngine::ScriptedEngine(services::Node& node)
    : deltas_(services::advertise(node, services::topics::plan_delta)) {
  plan.engine = "scripted";
  services::subscribe(node, services::topics::plan_receipt, [this](const v1::PlanReceipt& receipt) {
    if (receipt.open() && receipt.version() == 0 && !std::exchange(asked_, true)) on_open();
  });
}

PlanActivity& ScriptedEngine::image(const std::string& id, const std::vector<std::string>& after) {
  PlanActivity activity;
  activity.id = activity.name = id;
  activity.owner = "sim_svc";
  activity.subsystem = "camera";
  activity.command_name = "image";
  activity.arguments = {{"image", "image-" + id}};
  activity.commit = temporal::CommitState::committed;
  activity.start_point = plan.point_count++;
  activity.end_point = plan.point_count++;
  activity.duration_lower = activity.duration_upper = temporal::seconds(10);
  for (const std::string& earlier : after) {
    const auto before = std::ranges::find(plan.activities, earlier, &PlanActivity::id);
    plan.constraints.push_back({before->end_point, activity.start_point, ConstraintKind::ordering,
                                temporal::seconds(0), temporal::no_bound});
  }
  plan.activities.push_back(std::move(activity));
  return plan.activities.back();
}

temporal::DecisionPoint& ScriptedEngine::decision(const std::string& id, double before_s) {
  temporal::DecisionPoint added;
  added.id = id;
  added.decide_before = plan.point_count++;
  if (before_s >= 0)
    plan.constraints.push_back({temporal::origin_point, added.decide_before, ConstraintKind::window,
                                temporal::seconds(0), temporal::seconds(before_s)});
  plan.decisions.push_back(std::move(added));
  return plan.decisions.back();
}

void ScriptedEngine::send() {
  ++plan.version;
  deltas_.write(services::wire::to_wire(difference(told_, plan)));
  told_ = plan;
}

}  // namespace roci::scenario
