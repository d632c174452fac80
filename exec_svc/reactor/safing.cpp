#include "exec_svc/reactor/safing.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::reactor {

using executive::CommandAck;
using executive::CommandStage;
using executive::OutcomeKind;

namespace {

// Bounds how often a fall-back is sent again in a later epoch, of which the executive has learned by each
// refusal.
constexpr std::uint32_t kRefusals = 8;

}  // namespace

void Safing::make_safe(temporal::Time now, const std::string& reason) {
  begin(now, reason, "the ground");
  unheard_ = false;
}

void Safing::make_safe_unheard(temporal::Time now, const std::string& reason) {
  begin(now, reason, "the robot");
  unheard_ = true;
}

void Safing::begin(temporal::Time now, const std::string& reason, const std::string& goals_wait_for) {
  state_->phase = MissionPhase::safe;
  state_->replan_wanted = false;
  plan_->restore_validity();
  plan_->cancel(now);
  send_fallbacks();
  for (const goals::GoalKey& key : state_->open_goals())
    state_->set_goal(key, goals::GoalState::pending, "waiting for " + goals_wait_for + ": " + reason);
  await(now, reason);
}

void Safing::make_safe_again(temporal::Time now, const std::string& reason) {
  std::erase_if(fallbacks_, [](const auto& one) { return one.second.answered; });
  ++round_;  // watch() sends those that lack
  unheard_ = false;
  await(now, reason);
}

void Safing::await(temporal::Time now, const std::string& reason) {
  reason_ = reason;
  awaited_ = true;
  told_ = false;
  safe_by_ = now + state_->mission->executive.fallback_timeout;
}

void Safing::send_fallbacks() {
  sent_ = true;
  ++round_;
  repeat_at_.reset();
  fallbacks_.clear();
  for (const mission::Component* component : state_->beliefs.active()) send_fallback(*component);
}

void Safing::send_fallback(const mission::Component& component) {
  SentFallback& sent = fallbacks_[component.name];
  if (sent.activity.empty()) {
    sent.activity = executive::kFallbackPrefix + std::to_string(plan_->version()) + "." +
                    std::to_string(round_) + "." + component.name;
    sent.epoch = plan_->epoch();
  }
  executive::Command command;
  command.activity = sent.activity;
  command.epoch = sent.epoch;
  command.owner = component.owner;
  command.robot = component.robot;
  command.subsystem = component.name;
  command.command_name = component.fallback;
  state_->out.commands.push_back(std::move(command));
}

bool Safing::unanswered() const {
  return !sent_ || std::ranges::none_of(fallbacks_, [](const auto& one) { return one.second.answered; });
}

void Safing::take(const std::vector<CommandAck>& acks) {
  for (const CommandAck& ack : acks) {
    const auto found = std::ranges::find_if(fallbacks_, [&](const auto& one) {
      const std::uint64_t epoch = one.second.epoch;
      return one.second.activity == ack.activity && (ack.epoch == 0 || epoch == 0 || ack.epoch == epoch);
    });
    if (found == fallbacks_.end()) continue;
    SentFallback& sent = found->second;
    const auto component =
        std::ranges::find(state_->mission->components, found->first, &mission::Component::name);
    if (ack.refused_epoch && sent.refusals < kRefusals) {
      ++sent.refusals;
      sent.epoch = plan_->epoch();
      send_fallback(*component);
      continue;
    }
    const bool taken = ack.stage == CommandStage::accepted || ack.stage == CommandStage::completed;
    if (!taken && !sent.answered)
      state_->report(Severity::warning, "fallback.failed",
                     component->owner + " does not bring " + found->first + " to rest by " +
                         component->fallback + " [" + ack.code + "]: " + ack.reason);
    sent.answered = true;
  }
}

void Safing::watch(temporal::Time now) {
  if (state_->phase != MissionPhase::safe) awaited_ = false;
  if (awaited_ && !sent_ && !state_->beliefs.active().empty()) send_fallbacks();  // an owner has come back
  if (awaited_ && sent_) {
    for (const mission::Component* component : state_->beliefs.active())
      if (!fallbacks_.contains(component->name)) send_fallback(*component);  // active since
  }
  repeat_lost(now);
  if (awaited_) confirm(now);
}

void Safing::repeat_lost(temporal::Time now) {
  const mission::ReactorSettings& settings = state_->mission->executive;
  const bool waits = state_->phase == MissionPhase::pausing || awaited_ ||
                     (state_->phase == MissionPhase::safe && !settings.round_trips.empty());
  if (!sent_ || !waits) return;
  const bool due = repeat_at_ && now >= *repeat_at_;
  const auto active = state_->beliefs.active();
  std::optional<temporal::Duration> longest;
  for (const mission::Component& component : state_->mission->components) {
    const auto way = settings.round_trips.find(component.owner);
    const bool linked = way != settings.round_trips.end();
    const auto sent = fallbacks_.find(component.name);
    const bool active_still = std::ranges::find(active, &component) != active.end();
    const bool unanswered = awaited_ && sent != fallbacks_.end() && !sent->second.answered;
    if (!linked || (!active_still && !unanswered)) continue;
    longest = std::max(longest.value_or(temporal::Duration{0}), way->second);
    if (due) send_fallback(component);
  }
  if (!longest) return;
  if (!repeat_at_ || due) repeat_at_ = now + settings.ack_timeout + *longest;
  state_->wake_at(*repeat_at_);
}

void Safing::confirm(temporal::Time now) {
  const std::string lacks = missing();
  if (lacks.empty()) {
    awaited_ = false;
    const bool goes_on = std::exchange(unheard_, false);
    const char* next = goes_on ? "is seen to be at rest, and goes on: " : "made safe, waiting for the ground: ";
    state_->report(goes_on ? Severity::warning : Severity::error, "robot.safe", next + reason_);
    if (!goes_on || state_->goals.open().empty()) return;
    state_->want_plan("the robot is seen to be safe");
    state_->wake_at(now);
    return;
  }
  if (!told_) state_->report(Severity::warning, "robot.safing", "is made safe: " + reason_ + "; " + lacks);
  told_ = true;
  if (!safe_by_) return;
  if (now >= *safe_by_) {
    safe_by_.reset();
    state_->report(Severity::error, "robot.unsafe", "is not safe: " + lacks + "; " + reason_);
  } else {
    state_->wake_at(*safe_by_);
  }
}

/// Returns in plain words what is missing until the robot counts as safe, or an empty text if nothing is.
std::string Safing::missing() const {
  std::string out;
  const auto add = [&](const std::string& what) { out += (out.empty() ? "" : ", ") + what; };
  for (const mission::Component* component : state_->beliefs.active()) add(component->name + " is active");
  for (const auto& [component, sent] : fallbacks_)
    if (!sent.answered) add("the fall-back of " + component + " is not answered");
  if (plan_->outcome().kind == OutcomeKind::cancelling) add("commands are being cancelled");
  return out;
}

void Safing::resume() {
  sent_ = false;
  if (state_->phase == MissionPhase::safe && !state_->beliefs.active().empty()) send_fallbacks();
}

}  // namespace roci::exec::reactor
