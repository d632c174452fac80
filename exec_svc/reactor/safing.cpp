#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

void Safing::make_safe(temporal::Time now, const std::string& reason) {
  state_->phase = MissionPhase::safe;
  state_->replan_wanted = false;
  plan_->restore_validity();
  plan_->cancel(now);
  send_fallbacks();
  for (const goals::GoalKey& key : state_->open_goals())
    state_->set_goal(key, goals::GoalState::pending, "waiting for the ground: " + reason);
  state_->report(Severity::error, "robot.safe", "made safe, waiting for the ground: " + reason);
}

void Safing::send_fallbacks() {
  sent_ = true;
  ++round_;
  for (const mission::Component* component : state_->beliefs.active()) {
    executive::Command command;
    command.activity =
        "fallback." + std::to_string(plan_->version()) + "." + std::to_string(round_) + "." + component->name;
    command.owner = component->owner;
    command.robot = component->robot;
    command.subsystem = component->name;
    command.command_name = component->fallback;
    state_->out.commands.push_back(std::move(command));
  }
}

void Safing::resume() {
  sent_ = false;
  if (state_->phase == MissionPhase::safe && !state_->beliefs.active().empty()) send_fallbacks();
}

}  // namespace roci::exec::reactor
