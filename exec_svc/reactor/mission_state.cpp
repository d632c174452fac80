#include "exec_svc/reactor/mission_state.hpp"

#include <utility>

namespace roci::exec::reactor {

using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalState;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

void MissionState::want_plan(const std::string& reason) {
  replan_wanted = true;
  replan_reason = reason;
}

bool MissionState::replan_due() const {
  if (!replan_wanted || authority.held()) return false;
  return authority.may_replan() || phase == MissionPhase::idle || phase == MissionPhase::finished;
}

bool MissionState::tells_conclusion(const std::string& timeline) const {
  return !mission->executive.plans_continuously() || timeline.starts_with(kTrust);
}

void MissionState::report(Severity level, std::string code, std::string text) {
  out.events.push_back({level, std::move(code), std::move(text)});
}

void MissionState::set_goal(const GoalKey& key, GoalState goal_state, const std::string& reason,
                            std::uint32_t plan_version) {
  goals.set_state(key, goal_state, reason, plan_version);
  out.goal_changes.push_back(*goals.find(key));
}

void MissionState::give_up(const std::vector<GoalKey>& keys, const std::string& reason) {
  for (const GoalKey& key : keys) {
    const bool hard = goals.find(key)->request.importance == GoalClass::hard;
    set_goal(key, hard ? GoalState::failed : GoalState::dropped, reason);
    if (hard) {
      report(Severity::error, "goal.failed",
             "hard goal " + key.text() + " failed: " + first_line(reason) + "; the ground is asked");
    } else {
      report(Severity::warning, "goal.dropped", "goal " + key.text() + " dropped: " + first_line(reason));
    }
  }
}

std::vector<GoalKey> MissionState::open_goals() const {
  std::vector<GoalKey> out_keys;
  for (const GoalRecord* record : goals.open()) out_keys.push_back(record->request.key);
  return out_keys;
}

void MissionState::wake_at(temporal::Time time) {
  if (!out.wake || time < *out.wake) out.wake = time;
}

}  // namespace roci::exec::reactor
