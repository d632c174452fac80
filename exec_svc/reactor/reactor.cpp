#include "exec_svc/reactor/reactor.hpp"

#include <algorithm>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec {
namespace {

using temporal::Time;

// Activities whose windows are told to the ground when these move: what a screen shows, and no work in the
// size of the plan.
constexpr std::size_t kToldAhead = 32;

const char* code_of(Rung rung) {
  switch (rung) {
    case Rung::push:
      return "recovery.push";
    case Rung::retry:
      return "recovery.retry";
    case Rung::contingency:
      return "recovery.contingency";
  }
  return "recovery";
}

// The goals that an activity works for: those it serves, else those of the next one that serves any.
std::vector<GoalKey> goals_behind(const temporal::FlexiblePlan& plan, const std::string& activity,
                                  const GoalSet& goals) {
  const auto failed = std::find_if(plan.activities.begin(), plan.activities.end(),
                                   [&](const temporal::PlanActivity& one) { return one.id == activity; });
  for (auto one = failed; one != plan.activities.end(); ++one) {
    std::vector<GoalKey> out;
    for (const GoalRecord* record : goals.open()) {
      const auto& served = one->goals_served;
      if (std::find(served.begin(), served.end(), record->request.key.text()) != served.end())
        out.push_back(record->request.key);
    }
    if (!out.empty()) return out;
  }
  return {};
}

}  // namespace

Reactor::Reactor(const MissionModel& mission)
    : mission_(&mission),
      beliefs_(mission),
      goals_(mission),
      executive_(executive_settings(mission)),
      ladder_(ladder_of(mission.executive.recovery)),
      failures_(mission.executive.failure_limit, mission.executive.failure_pause,
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

void Reactor::take_peers(const ReactorInputs& inputs) {
  for (const PeerLoss& loss : inputs.losses) {
    note(NoteLevel::warning, "service.lost", loss.service + " was lost: " + loss.cause);
  }
  for (const std::string& service : inputs.arrivals) {
    note(NoteLevel::info, "service.found", service + " is there");
    if (phase_ == Phase::safe && !goals_.open().empty()) want_plan(service + " came back");
    failed_calls_ = 0;
    not_before_ = Time{0};
    fallbacks_sent_ = false;  // one that came back has not heard them
  }
}

void Reactor::take_models(const std::vector<ModelVersion>& models) {
  for (const ModelVersion& model : models) {
    const auto [known, is_new] = models_.try_emplace(model.owner, model.version);
    if (is_new || known->second == model.version) continue;
    known->second = model.version;
    models_changed_ = true;
  }
}

void Reactor::take_goals(Time now, const std::vector<GoalRequest>& requests) {
  for (const GoalRequest& request : goals_.in_order(requests)) {
    const GoalRecord* record = goals_.submit(request, now);
    if (record == nullptr) continue;
    out_.goal_changes.push_back(*record);
    const std::string name = "goal " + record->request.key.text();
    if (record->state == GoalState::rejected) {
      note(NoteLevel::warning, "goal.rejected", name + " rejected: " + record->reason);
    } else if (record->request != request && !request.recalled) {
      note(NoteLevel::warning, "goal.refused", name + ": " + record->reason);
    } else if (record->state == GoalState::recalled) {
      note(NoteLevel::info, "goal.recalled", name + " recalled");
      if (phase_ == Phase::executing || phase_ == Phase::planning) want_plan(name + " was recalled");
    } else if (record->state == GoalState::pending) {
      note(NoteLevel::info, "goal.accepted", name + " accepted");
      assume_unobserved(record->request);
      reserves_ = Reserves::kept;
      want_plan(name + " arrived");
    }
  }
}

void Reactor::assume_unobserved(const GoalRequest& goal) {
  const auto values = template_values(goal);
  for (const auto& [timeline, templates] : mission_->goal_kinds.at(goal.kind).unobserved) {
    std::vector<std::string> facts;
    for (const std::string& fact : templates) facts.push_back(fill_names(fact, values));
    beliefs_.assume(fill_names(timeline, values), std::move(facts));
  }
}

void Reactor::note_achieved() {
  for (const GoalRecord* record : goals_.open()) {
    if (!beliefs_.holds(goal_facts(*mission_, record->request))) continue;
    const GoalKey key = record->request.key;
    change_goal(key, GoalState::achieved, "observed");
    note(NoteLevel::info, "goal.achieved", "goal " + key.text() + " achieved");
  }
}

// The executive hears what happened in every phase, so that cancels are answered and observations kept.
void Reactor::run_executive(Time now, const ReactorInputs& inputs) {
  Inputs told;
  told.observations = inputs.observations;
  for (Observation& change : changed_conditions()) {
    foresight_.observe(change.timeline, change.value);
    told.observations.push_back(std::move(change));
  }
  told.acks = inputs.acks;
  for (const PeerLoss& loss : inputs.losses) told.lost_owners.push_back(loss.service);
  Outputs done = executive_.step(now, told);
  for (const StepStatus& step : done.changes) {
    foresight_.change(step.activity, step.state);
    if (step.state != temporal::ActivityState::waiting) margins_.leave(step.activity);
    if (step.state != temporal::ActivityState::succeeded) continue;
    if (const auto* activity = executive_.activity(step.activity)) failures_.succeeded(activity->subsystem);
  }
  for (const RecoveryStep& recovery : done.recoveries)
    note(NoteLevel::info, code_of(recovery.rung), recovery.activity + ": " + recovery.cause);
  pass_on(std::move(done));
  if (!out_.steps.empty() && phase_ == Phase::executing) tell_windows();
}

void Reactor::pass_on(Outputs done) {
  std::move(done.commands.begin(), done.commands.end(), std::back_inserter(out_.commands));
  std::move(done.changes.begin(), done.changes.end(), std::back_inserter(out_.steps));
  if (done.next_wake) wake_at(*done.next_wake);
}

// Windows of what starts next, where real events have moved them.
void Reactor::tell_windows() {
  for (const StepStatus& step : executive_.upcoming(kToldAhead)) {
    const auto [told, added] = told_starts_.try_emplace(step.activity, step.earliest_start);
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
  if (follows_engine()) return follow_engine(now, inputs);
  const bool answered = call_open_ && inputs.answer && inputs.answer->call == call_id_;
  if (answered) {
    call_open_ = false;
    if (phase_ == Phase::planning && !wanted_) take_answer(now, *inputs.answer);
    if (meanwhile_) meanwhile_->answer = *inputs.answer;
  }
  if (phase_ == Phase::executing) follow_plan(now);
  if (meanwhile_) continue_meanwhile(now);
  if (wanted_ && phase_ != Phase::pausing && (phase_ != Phase::planning || answered)) {
    if (!may_go_on()) {
      begin_pause(now);
    } else if (!call_open_) {
      begin_meanwhile(now);
    }
  }
  if (phase_ == Phase::pausing) continue_pause(now);
  cancel_stale_call();
  finish_if_done();
}

void Reactor::follow_plan(Time now) {
  const Outcome outcome = executive_.outcome();
  if (outcome.kind == OutcomeKind::broken) {
    break_plan(now, (outcome.activity.empty() ? "" : outcome.activity + ": ") + outcome.cause);
    if (wanted_ && outcome.reason == BreakReason::activity_failed) count_failure(now, outcome);
    if (wanted_ && outcome.reason == BreakReason::refused_for_good) {
      give_up(goals_behind(executive_.plan(), outcome.activity, goals_),
              outcome.activity + " will never be taken: " + outcome.cause);
    }
  } else if (outcome.kind == OutcomeKind::finished && !meanwhile_) {
    note(NoteLevel::info, "plan.finished", "plan " + std::to_string(plan_version_) + " finished");
    phase_ = Phase::idle;
    if (!goals_.open().empty()) want_plan("the plan ended with goals open");
  } else if (outcome.kind == OutcomeKind::running && !wanted_) {
    look_ahead(now);
  }
}

// Conflicts of activities that are not due yet.
void Reactor::look_ahead(Time now) {
  const std::string lacking =
      margins_.lacking([this](const std::string& timeline) { return beliefs_.lookup(timeline); });
  if (!lacking.empty()) return break_plan(now, lacking);
  if (const auto conflict = foresight_.conflict(now)) {
    const auto steps = executive_.steps();
    const auto due = std::ranges::find(steps, conflict->activity, &StepStatus::activity);
    break_plan(now, conflict->activity + ", due at " + temporal::to_text(due->earliest_start) +
                        ", will lack " + conflict->words + ", and nothing in the plan brings it about");
  } else if (const auto next = foresight_.next_look()) {
    wake_at(*next);
  }
}

// The way on is what the ladder still has: a new plan, else the ground, else nothing (R102).
void Reactor::break_plan(Time now, const std::string& why) {
  const std::string plan = "plan " + std::to_string(plan_version_);
  unfit_ = true;
  note(NoteLevel::warning, "plan.broken", plan + " is broken: " + why);
  if (ladder_.replans) {
    want_plan(plan + " is broken");
    return;
  }
  if (!ladder_.asks_ground) {
    std::vector<GoalKey> open;
    for (const GoalRecord* record : goals_.open()) open.push_back(record->request.key);
    give_up(open, plan + " broke, and nothing is mended in this run: " + why);
  }
  make_safe(now, plan + " broke: " + why);
}

// A component that keeps failing gets ever more time to recover; in the end its goals are given up.
void Reactor::count_failure(Time now, const Outcome& outcome) {
  const temporal::PlanActivity* activity = executive_.activity(outcome.activity);
  if (activity == nullptr || activity->subsystem.empty()) return;
  const FailureTally::Count count = failures_.failed(activity->subsystem);
  if (count.used_up) {
    give_up(goals_behind(executive_.plan(), outcome.activity, goals_),
            activity->subsystem + " failed " + std::to_string(count.in_a_row) + " times in a row, last as " +
                outcome.activity + " " + outcome.cause);
  } else if (count.pause > temporal::Duration{0}) {
    not_before_ = now + count.pause;
  }
}

// Hard goals are never dropped: they fail, and the ground is asked.
void Reactor::give_up(const std::vector<GoalKey>& goals, const std::string& why) {
  for (const GoalKey& key : goals) {
    const bool hard = goals_.find(key)->request.importance == GoalClass::hard;
    change_goal(key, hard ? GoalState::failed : GoalState::dropped, why);
    if (hard) {
      note(NoteLevel::error, "goal.failed",
           "hard goal " + key.text() + " failed: " + why + "; the ground is asked");
    } else {
      note(NoteLevel::warning, "goal.dropped", "goal " + key.text() + " dropped: " + why);
    }
  }
}

void Reactor::finish_if_done() {
  const bool resting = phase_ == Phase::idle || phase_ == Phase::finished;
  if (resting && !wanted_ && goals_.open().empty() && !goals_.all().empty()) phase_ = Phase::finished;
}

void Reactor::want_plan(const std::string& why) {
  wanted_ = true;
  wanted_why_ = why;
}

void Reactor::change_goal(const GoalKey& key, GoalState state, const std::string& reason) {
  goals_.set_state(key, state, reason);
  out_.goal_changes.push_back(*goals_.find(key));
}

void Reactor::wake_at(Time time) {
  if (!out_.wake || time < *out_.wake) out_.wake = time;
}

void Reactor::note(NoteLevel level, std::string code, std::string text) {
  out_.notes.push_back({level, std::move(code), std::move(text)});
}

ReactorCounts Reactor::counts() const {
  ReactorCounts counts = counts_;
  for (const GoalRecord* record : goals_.all()) {
    if (record->state == GoalState::achieved) ++counts.achieved;
    if (record->state == GoalState::dropped) ++counts.dropped;
    if (record->state == GoalState::failed) ++counts.failed;
    if (!is_final(record->state)) ++counts.open;
  }
  return counts;
}

std::string Reactor::outcome() const {
  if (phase_ == Phase::safe) return beliefs_.active().empty() ? "partial" : "failed";
  if (phase_ != Phase::finished) return "";
  auto taken = goals_.all();
  std::erase_if(taken, [](const GoalRecord* record) { return record->state == GoalState::rejected; });
  const bool every_hard_goal = std::all_of(taken.begin(), taken.end(), [](const GoalRecord* record) {
    return record->request.importance != GoalClass::hard || record->state == GoalState::achieved ||
           record->state == GoalState::recalled;
  });
  return every_hard_goal && !taken.empty() ? "achieved" : "partial";
}

}  // namespace roci::exec
