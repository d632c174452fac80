#include "exec_svc/reactor/safing.hpp"

#include <algorithm>

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
  repeat_at_.reset();
  for (const mission::Component* component : state_->beliefs.active()) send_fallback(*component);
}

void Safing::send_fallback(const mission::Component& component) {
  executive::Command command;
  command.activity =
      "fallback." + std::to_string(plan_->version()) + "." + std::to_string(round_) + "." + component.name;
  command.owner = component.owner;
  command.robot = component.robot;
  command.subsystem = component.name;
  command.command_name = component.fallback;
  state_->out.commands.push_back(std::move(command));
}

void Safing::repeat_lost(temporal::Time now) {
  const mission::ReactorSettings& settings = state_->mission->executive;
  const bool waits = state_->phase == MissionPhase::pausing || state_->phase == MissionPhase::safe;
  if (settings.round_trips.empty() || !sent_ || !waits) return;
  const bool due = repeat_at_ && now >= *repeat_at_;
  std::optional<temporal::Duration> longest;
  for (const mission::Component* component : state_->beliefs.active()) {
    const auto way = settings.round_trips.find(component->owner);
    if (way == settings.round_trips.end()) continue;
    longest = std::max(longest.value_or(way->second), way->second);
    if (due) send_fallback(*component);
  }
  if (!longest) return;
  if (!repeat_at_ || due) repeat_at_ = now + settings.ack_timeout + *longest;
  state_->wake_at(*repeat_at_);
}

void Safing::resume() {
  sent_ = false;
  if (state_->phase == MissionPhase::safe && !state_->beliefs.active().empty()) send_fallbacks();
}

}  // namespace roci::exec::reactor
