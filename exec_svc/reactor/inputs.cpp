#include "exec_svc/reactor/inputs.hpp"

#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/problem/problem_writer.hpp"

namespace roci::exec::reactor {

using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalSet;
using goals::GoalState;
using mission::fill_names;
using temporal::Time;

bool take_goals(MissionState& state, Time now, const std::vector<GoalRequest>& requests) {
  bool accepted = false;
  for (const GoalRequest& request : state.goals.in_reference_order(requests)) {
    const auto [disposition, record] = state.goals.submit(request, now);
    if (disposition == GoalSet::Disposition::known) continue;
    state.out.goal_changes.push_back(*record);
    const std::string name = "goal " + record->request.key.text();
    if (disposition == GoalSet::Disposition::rejected) {
      state.report(Severity::warning, "goal.rejected", name + " rejected: " + record->reason);
    } else if (disposition == GoalSet::Disposition::refused) {
      state.report(Severity::warning, "goal.refused", name + ": " + record->reason);
    } else if (disposition == GoalSet::Disposition::recalled) {
      state.report(Severity::info, "goal.recalled", name + " recalled");
      if (state.phase == MissionPhase::executing || state.phase == MissionPhase::planning)
        state.want_plan(name + " was recalled");
    } else if (disposition == GoalSet::Disposition::accepted) {
      state.report(Severity::info, "goal.accepted", name + " accepted");
      assume_unobserved(state, record->request);
      state.want_plan(name + " arrived");
      accepted = true;
    }
  }
  return accepted;
}

bool take_handed_over(MissionState& state, const std::vector<GoalRecord>& records) {
  bool opened = false;
  for (const GoalRecord& theirs : records) {
    const GoalRecord* before = state.goals.find(theirs.request.key);
    const bool was_open = before != nullptr && !is_final(before->state);
    const GoalRecord* record = state.goals.merge(theirs);
    if (record == nullptr) continue;
    state.out.goal_changes.push_back(*record);
    const std::string name = "goal " + record->request.key.text();
    state.report(Severity::info, "goal.merged", name + " is taken over from the other executive");
    if (record->state == GoalState::rejected) continue;
    assume_unobserved(state, record->request);
    const bool is_open = !is_final(record->state);
    if (is_open) {
      state.want_plan(name + " was taken over");
      opened = true;
    } else if (was_open &&
               (state.phase == MissionPhase::executing || state.phase == MissionPhase::planning)) {
      state.want_plan(name + " was " +
                      (record->state == GoalState::recalled ? "recalled" : "ended by another"));
    }
  }
  return opened;
}

void assume_unobserved(MissionState& state, const GoalRequest& goal) {
  const auto values = template_values(goal);
  for (const auto& [timeline, templates] : state.mission->goal_kinds.at(goal.kind).unobserved) {
    std::vector<std::string> facts;
    for (const std::string& fact : templates) facts.push_back(fill_names(fact, values));
    state.beliefs.assume(fill_names(timeline, values), std::move(facts));
  }
}

void note_achieved(MissionState& state, Time now) {
  for (const GoalRecord* record : state.goals.open()) {
    if (!problem::is_achieved(*state.mission, state.beliefs, state.goals, record->request, now)) continue;
    const GoalKey key = record->request.key;
    state.set_goal(key, GoalState::achieved, "observed");
    state.report(Severity::info, "goal.achieved", "goal " + key.text() + " achieved");
  }
}

}  // namespace roci::exec::reactor
