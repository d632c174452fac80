#include "exec_svc/reactor/reactor.hpp"

#include <algorithm>

namespace roci::exec::reactor {

using executive::Inputs;
using executive::Observation;
using executive::Outputs;
using executive::RecoveryAction;
using executive::RecoveryStep;
using executive::StepStatus;
using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalState;
using mission::MissionModel;
using problem::goal_facts;

namespace {

using temporal::Time;

// Activities whose windows are told to the ground when these move: what a screen shows, and no work in the
// size of the plan.
constexpr std::size_t kReportedAhead = 32;

const char* code_of(RecoveryAction action) {
  switch (action) {
    case RecoveryAction::push:
      return "recovery.push";
    case RecoveryAction::retry:
      return "recovery.retry";
    case RecoveryAction::contingency:
      return "recovery.contingency";
  }
  return "recovery";
}

}  // namespace

Reactor::Reactor(const MissionModel& mission)
    : mission_(&mission),
      beliefs_(mission),
      goals_(mission),
      executive_(executive_settings(mission)),
      recovery_policy_(recovery_policy_of(mission.executive.recovery)),
      failure_backoff_(mission.executive.failure_limit, mission.executive.failure_pause,
                       mission.executive.failure_pause_max) {}

void Reactor::restore(const std::vector<GoalRecord>& goals, std::uint32_t last_plan_version) {
  for (const GoalRecord& record : goals) {
    goals_.restore(record);
    if (record.state != GoalState::rejected) assume_unobserved(record.request);
  }
  plan_version_ = last_plan_version;
  first_plan_ = last_plan_version == 0;
  if (!goals_.open().empty()) want_plan("restarted with open goals");
}

ReactorOutputs Reactor::step(Time now, const ReactorInputs& inputs) {
  out_ = {};
  for (const Observation& observation : inputs.observations)
    beliefs_.observe(observation.timeline, observation.value);
  take_peers(inputs);
  take_models(inputs.models);
  take_goals(now, inputs.goals);
  note_achieved();
  run_executive(now, inputs);
  if (inputs.restarted) resume(now);
  advance(now, inputs);
  return std::move(out_);
}

void Reactor::note_achieved() {
  for (const GoalRecord* record : goals_.open()) {
    if (!beliefs_.holds(goal_facts(*mission_, record->request))) continue;
    const GoalKey key = record->request.key;
    change_goal(key, GoalState::achieved, "observed");
    report(Severity::info, "goal.achieved", "goal " + key.text() + " achieved");
  }
}

// The executive hears what happened in every phase, so that cancels are answered and observations kept.
void Reactor::run_executive(Time now, const ReactorInputs& inputs) {
  Inputs told;
  told.observations = inputs.observations;
  for (Observation& change : changed_conditions()) {
    conflict_monitor_.observe(change.timeline, change.value);
    told.observations.push_back(std::move(change));
  }
  told.acks = inputs.acks;
  for (const PeerLoss& loss : inputs.losses) told.lost_owners.push_back(loss.service);
  Outputs done = executive_.step(now, told);
  for (const StepStatus& step : done.changes) {
    conflict_monitor_.change(step.activity, step.state);
    if (step.state != temporal::ActivityState::waiting) resource_monitor_.remove(step.activity);
    if (step.state != temporal::ActivityState::succeeded) continue;
    if (const auto* activity = executive_.activity(step.activity))
      failure_backoff_.succeeded(activity->subsystem);
  }
  for (const RecoveryStep& recovery : done.recoveries)
    report(Severity::info, code_of(recovery.action), recovery.activity + ": " + recovery.reason);
  forward(std::move(done));
  if (!out_.steps.empty() && phase_ == MissionPhase::executing) report_windows();
}

void Reactor::forward(Outputs done) {
  std::move(done.commands.begin(), done.commands.end(), std::back_inserter(out_.commands));
  std::move(done.changes.begin(), done.changes.end(), std::back_inserter(out_.steps));
  if (done.next_wake) wake_at(*done.next_wake);
}

// Windows of what starts next, where real events have moved them.
void Reactor::report_windows() {
  for (const StepStatus& step : executive_.upcoming(kReportedAhead)) {
    const auto [told, added] = reported_starts_.try_emplace(step.activity, step.earliest_start);
    if (!added && told->second == step.earliest_start) continue;
    told->second = step.earliest_start;
    out_.steps.push_back(step);
  }
}

// Facts are derived from observations here, where the metadata is; the executive sees each as one more
// timeline.
std::vector<Observation> Reactor::changed_conditions() {
  std::vector<Observation> out;
  for (auto& [name, last] : condition_values_) {
    auto value = beliefs_.lookup(name);
    if (!value || *value == last) continue;
    last = *value;
    out.push_back({name, std::move(*value)});
  }
  return out;
}

// A wish for a plan that comes up during a planner call cancels it and waits for its end: there is never more
// than one call.
void Reactor::advance(Time now, const ReactorInputs& inputs) {
  if (follows_engine()) return step_continuous(now, inputs);
  const bool answered = call_open_ && inputs.reply && inputs.reply->call == call_id_;
  if (answered) {
    call_open_ = false;
    if (phase_ == MissionPhase::planning && !replan_wanted_) take_answer(now, *inputs.reply);
    if (background_replan_) background_replan_->reply = *inputs.reply;
  }
  if (phase_ == MissionPhase::executing) monitor_plan(now);
  if (background_replan_) continue_background_replan(now);
  if (replan_wanted_ && phase_ != MissionPhase::pausing && (phase_ != MissionPhase::planning || answered)) {
    if (!can_replan_in_background()) {
      begin_pause(now);
    } else if (!call_open_) {
      begin_background_replan(now);
    }
  }
  if (phase_ == MissionPhase::pausing) continue_pause(now);
  cancel_stale_call();
  finish_if_done();
}

void Reactor::finish_if_done() {
  const bool resting = phase_ == MissionPhase::idle || phase_ == MissionPhase::finished;
  if (resting && !replan_wanted_ && goals_.open().empty() && !goals_.all().empty())
    phase_ = MissionPhase::finished;
}

void Reactor::want_plan(const std::string& reason) {
  replan_wanted_ = true;
  replan_reason_ = reason;
}

void Reactor::change_goal(const GoalKey& key, GoalState state, const std::string& reason) {
  goals_.set_state(key, state, reason);
  out_.goal_changes.push_back(*goals_.find(key));
}

void Reactor::wake_at(Time time) {
  if (!out_.wake || time < *out_.wake) out_.wake = time;
}

void Reactor::report(Severity level, std::string code, std::string text) {
  out_.events.push_back({level, std::move(code), std::move(text)});
}

ReactorCounts Reactor::counts() const {
  ReactorCounts counts = counts_;
  for (const GoalRecord* record : goals_.all()) {
    if (record->state == GoalState::achieved) ++counts.achieved;
    if (record->state == GoalState::dropped) ++counts.dropped;
    if (record->state == GoalState::failed) ++counts.failed;
    if (record->state == GoalState::rejected) ++counts.rejected;
    if (!is_final(record->state)) ++counts.open;
  }
  return counts;
}

std::string Reactor::outcome() const {
  if (phase_ == MissionPhase::safe) return beliefs_.active().empty() ? "partial" : "failed";
  if (phase_ != MissionPhase::finished) return "";
  auto asked = goals_.all();
  std::erase_if(asked, [](const GoalRecord* record) {
    return record->state == GoalState::rejected && from_console(record->request);
  });
  const bool every_hard_goal = std::all_of(asked.begin(), asked.end(), [](const GoalRecord* record) {
    return record->request.importance != GoalClass::hard || record->state == GoalState::achieved ||
           record->state == GoalState::recalled;
  });
  return every_hard_goal && !asked.empty() ? "achieved" : "partial";
}

}  // namespace roci::exec::reactor
