// Reactor: from a wish for a plan to the planner call. What runs is cancelled, what is still active falls
// back (R43, R44), then the problem is written. Where that fails, the robot is made safe.
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using executive::Command;
using executive::OutcomeKind;
using goals::GoalRecord;
using goals::GoalState;
using mission::Component;
using problem::Forecast;

namespace {

using temporal::Time;

std::string names_of(const std::vector<const Component*>& components) {
  std::string out;
  for (const Component* component : components) out += (out.empty() ? "" : ", ") + component->name;
  return out;
}

}  // namespace

// False: there were too many, and the robot is safe.
bool Reactor::count_replan(Time now) {
  if (first_plan_ || ++counts_.replans <= mission_->executive.replan_limit) return true;
  make_safe(now, "the limit of " + std::to_string(mission_->executive.replan_limit) +
                     " replans is reached; the last: " + replan_reason_);
  return false;
}

void Reactor::begin_pause(Time now) {
  if (goals_.open().empty() && phase_ != MissionPhase::executing && phase_ != MissionPhase::planning) {
    replan_wanted_ = false;
    return;
  }
  if (!beliefs_.unobserved().empty())
    return;  // the first observation of the last component brings us here again
  replan_wanted_ = false;
  report(Severity::info, "plan.wanted", replan_reason_);
  if (!count_replan(now)) return;
  background_replan_.reset();
  plan_invalid_ = false;
  phase_ = MissionPhase::pausing;
  pause_deadline_ = now + mission_->executive.fallback_timeout;
  fallbacks_sent_ = false;
  forward(executive_.cancel_all(now));
}

void Reactor::continue_pause(Time now) {
  const bool stopping = executive_.outcome().kind == OutcomeKind::cancelling;
  if (!stopping && beliefs_.active().empty()) {
    if (call_open_) return;  // of before the pause; its answer brings us here again
    if (now < next_call_at_ && !goals_.open().empty()) {
      wake_at(next_call_at_);
    } else {
      begin_planning(now);
    }
  } else if (now >= pause_deadline_) {
    make_safe(now, names_of(beliefs_.active()) + " did not become inactive in time");
  } else {
    if (!stopping && !fallbacks_sent_) send_fallbacks();
    wake_at(pause_deadline_);
  }
}

void Reactor::send_fallbacks() {
  fallbacks_sent_ = true;
  ++fallback_round_;
  for (const Component* component : beliefs_.active()) {
    Command command;
    command.activity = "fallback." + std::to_string(plan_version_) + "." + std::to_string(fallback_round_) +
                       "." + component->name;
    command.owner = component->owner;
    command.subsystem = component->name;
    command.command_name = component->fallback;
    out_.commands.push_back(std::move(command));
  }
}

void Reactor::begin_planning(Time now) {
  replan_wanted_ = false;  // the problem holds all that is known now
  if (goals_.open().empty()) {
    phase_ = MissionPhase::idle;
    return;
  }
  phase_ = MissionPhase::planning;
  soft_goals_left_out_.clear();
  call_planner(now, now + mission_->planner.allowance, {});
}

void Reactor::call_planner(Time now, Time origin, const Forecast& forecast) {
  ++counts_.planner_calls;
  models_changed_ = false;
  call_open_ = true;
  call_cancelled_ = false;
  call_.id = ++call_id_;
  call_.problem_name = mission_->name + "-" + std::to_string(call_id_);
  call_.origin = origin;
  call_.problem = write_problem(*mission_, beliefs_, soft_goals_left_out_.empty() ? goals_ : hard_goals(),
                                call_.problem_name, now, origin, reserves_, forecast);
  call_.remaining = remaining();
  out_.call = call_;
}

std::vector<PlannedAction> Reactor::remaining() const {
  return remaining_actions(planned_, executive_.steps());
}

void Reactor::make_safe(Time now, const std::string& reason) {
  phase_ = MissionPhase::safe;
  replan_wanted_ = false;
  background_replan_.reset();
  plan_invalid_ = false;
  forward(executive_.cancel_all(now));
  send_fallbacks();
  for (const GoalRecord* record : goals_.open()) {
    goals_.set_state(record->request.key, GoalState::pending, "waiting for the ground: " + reason);
    out_.goal_changes.push_back(*goals_.find(record->request.key));
  }
  report(Severity::error, "robot.safe", "made safe, waiting for the ground: " + reason);
}

}  // namespace roci::exec::reactor
