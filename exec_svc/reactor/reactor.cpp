#include "exec_svc/reactor/reactor.hpp"

#include <algorithm>

#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/reactor/plan_binding.hpp"

namespace roci::exec {
namespace {

using temporal::Time;

ExecutiveSettings executive_settings(const MissionModel& mission) {
  ExecutiveSettings settings;
  settings.ack_timeout = mission.executive.ack_timeout;
  settings.cancel_timeout = mission.executive.ack_timeout;
  return settings;
}

// Whether a verdict says something about the goals (they do not fit), or only about the services.
bool speaks_of_goals(PlanVerdict verdict) {
  return verdict == PlanVerdict::unsolvable || verdict == PlanVerdict::timeout ||
         verdict == PlanVerdict::out_of_memory;
}

std::string names_of(const std::vector<const Component*>& components) {
  std::string out;
  for (const Component* component : components) out += (out.empty() ? "" : ", ") + component->name;
  return out;
}

}  // namespace

Reactor::Reactor(const MissionModel& mission)
    : mission_(&mission), beliefs_(mission), goals_(mission), executive_(executive_settings(mission)) {}

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
  take_goals(now, inputs.goals);
  note_achieved();
  run_executive(now, inputs);
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
  }
}

void Reactor::take_goals(Time now, const std::vector<GoalRequest>& requests) {
  for (const GoalRequest& request : requests) {
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
  for (Observation& change : changed_conditions()) told.observations.push_back(std::move(change));
  told.acks = inputs.acks;
  for (const PeerLoss& loss : inputs.losses) told.lost_owners.push_back(loss.service);
  Outputs done = executive_.step(now, told);
  std::move(done.commands.begin(), done.commands.end(), std::back_inserter(out_.commands));
  std::move(done.changes.begin(), done.changes.end(), std::back_inserter(out_.steps));
  if (done.next_wake) wake_at(*done.next_wake);
  if (!out_.steps.empty() && phase_ == Phase::executing) tell_windows();
}

// Windows of what has not started yet, where real events have moved them.
void Reactor::tell_windows() {
  for (const StepStatus& step : executive_.steps()) {
    if (step.state != temporal::ActivityState::waiting) continue;
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

void Reactor::advance(Time now, const ReactorInputs& inputs) {
  if (inputs.answer && phase_ == Phase::planning && inputs.answer->call == call_id_)
    take_answer(now, *inputs.answer);
  if (phase_ == Phase::executing) follow_plan(now);
  if (wanted_ && (phase_ == Phase::idle || phase_ == Phase::executing || phase_ == Phase::planning ||
                  phase_ == Phase::safe || phase_ == Phase::finished)) {
    begin_pause(now);
  }
  if (phase_ == Phase::pausing) continue_pause(now);
  finish_if_done();
}

void Reactor::follow_plan(Time) {
  const Outcome outcome = executive_.outcome();
  if (outcome.kind == OutcomeKind::broken) {
    note(NoteLevel::warning, "plan.broken",
         "plan " + std::to_string(plan_version_) + " is broken: " + outcome.cause);
    want_plan("plan " + std::to_string(plan_version_) + " broke: " + outcome.cause);
  } else if (outcome.kind == OutcomeKind::finished) {
    note(NoteLevel::info, "plan.finished", "plan " + std::to_string(plan_version_) + " finished");
    phase_ = Phase::idle;
    if (!goals_.open().empty()) want_plan("the plan ended with goals open");
  }
}

void Reactor::begin_pause(Time now) {
  if (goals_.open().empty() && phase_ != Phase::executing && phase_ != Phase::planning) {
    wanted_ = false;
    return;
  }
  if (now < not_before_) {
    wake_at(not_before_);
    return;
  }
  if (!beliefs_.unseen().empty()) return;  // the first observation of the last component brings us here again
  wanted_ = false;
  note(NoteLevel::info, "plan.wanted", wanted_why_);
  if (!first_plan_ && ++counts_.replans > mission_->executive.replan_limit) {
    make_safe(now, "the limit of " + std::to_string(mission_->executive.replan_limit) +
                       " replans is reached; the last: " + wanted_why_);
    return;
  }
  phase_ = Phase::pausing;
  pause_deadline_ = now + mission_->executive.fallback_timeout;
  fallbacks_sent_ = false;
  Outputs cancelled = executive_.cancel_all(now);
  std::move(cancelled.commands.begin(), cancelled.commands.end(), std::back_inserter(out_.commands));
  std::move(cancelled.changes.begin(), cancelled.changes.end(), std::back_inserter(out_.steps));
  if (cancelled.next_wake) wake_at(*cancelled.next_wake);
}

void Reactor::continue_pause(Time now) {
  wake_at(pause_deadline_);
  const bool stopping = executive_.outcome().kind == OutcomeKind::cancelling;
  if (!stopping && beliefs_.active().empty()) {
    begin_planning(now);
  } else if (now >= pause_deadline_) {
    make_safe(now, names_of(beliefs_.active()) + " did not become inactive in time");
  } else if (!stopping && !fallbacks_sent_) {
    send_fallbacks(now);
  }
}

void Reactor::send_fallbacks(Time) {
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
  if (goals_.open().empty()) {
    phase_ = Phase::idle;
    return;
  }
  phase_ = Phase::planning;
  ++counts_.planner_calls;
  call_.id = ++call_id_;
  call_.problem_name = mission_->name + "-" + std::to_string(call_id_);
  call_.origin = now + mission_->planner.allowance;
  call_.problem = write_problem(*mission_, beliefs_, goals_, call_.problem_name, now, call_.origin);
  out_.call = call_;
}

void Reactor::take_answer(Time now, const PlanAnswer& answer) {
  if (answer.verdict == PlanVerdict::solved) {
    adopt(now, answer);
  } else if (speaks_of_goals(answer.verdict)) {
    failed_calls_ = 0;
    give_way(answer);
    begin_planning(now);
  } else {
    try_again_later(now, answer);
  }
}

void Reactor::adopt(Time now, const PlanAnswer& answer) {
  failed_calls_ = 0;
  temporal::FlexiblePlan plan = answer.plan;
  plan.origin = call_.origin;
  std::string fault = bind_plan(plan, plan_version_ + 1, *mission_, call_.problem, beliefs_, goals_);
  if (fault.empty()) {
    const auto faults = executive_.load(plan, now);
    if (!faults.empty()) fault = faults.front();
  }
  if (!fault.empty()) {
    make_safe(now, "the planner's plan cannot be executed: " + fault);
    return;
  }
  ++plan_version_;
  first_plan_ = false;
  phase_ = Phase::executing;
  condition_values_.clear();
  for (const temporal::PlanActivity& activity : plan.activities) {
    for (const temporal::Condition* condition : {&activity.pre, &activity.maintenance}) {
      for (const std::string& name : temporal::timelines_of(*condition)) condition_values_[name] = {};
    }
  }
  for (const GoalRecord* record : goals_.open()) {
    const GoalKey key = record->request.key;
    goals_.set_state(key, GoalState::planned, "in plan " + std::to_string(plan_version_), plan_version_);
    out_.goal_changes.push_back(*goals_.find(key));
  }
  note(NoteLevel::info, "plan.adopted",
       "plan " + std::to_string(plan_version_) + " with " + std::to_string(plan.activities.size()) +
           " activities");
  out_.adopted = std::move(plan);
  told_starts_.clear();
  tell_windows();
  wake_at(now);
}

void Reactor::give_way(const PlanAnswer& answer) {
  const bool proved = answer.verdict == PlanVerdict::unsolvable;
  const std::string why = std::string(proved ? "proved that not all goals fit" : to_string(answer.verdict)) +
                          (answer.reason.empty() ? "" : ": " + answer.reason);
  // Goals that are proved out of reach take no other goal with them.
  std::vector<GoalKey> leaving = proved ? named_goals(answer.reason) : std::vector<GoalKey>{};
  if (leaving.empty()) {
    const auto victim = goals_.drop_candidate();
    leaving.push_back(victim ? *victim : goals_.open().back()->request.key);
  }
  for (const GoalKey& key : leaving) give_up(key, why);
}

// Hard goals are never dropped: they fail, and the ground is asked.
void Reactor::give_up(const GoalKey& key, const std::string& why) {
  if (goals_.find(key)->request.importance == GoalClass::hard) {
    change_goal(key, GoalState::failed, why);
    note(NoteLevel::error, "goal.failed",
         "hard goal " + key.text() + " failed: " + why + "; the ground is asked");
  } else {
    change_goal(key, GoalState::dropped, why);
    note(NoteLevel::warning, "goal.dropped", "goal " + key.text() + " dropped: " + why);
  }
}

// Open goals of which a fact stands in the planner's reason.
std::vector<GoalKey> Reactor::named_goals(const std::string& reason) const {
  std::vector<GoalKey> out;
  for (const GoalRecord* record : goals_.open()) {
    const auto facts = goal_facts(*mission_, record->request);
    const auto named = [&](const std::string& fact) { return reason.find(fact) != std::string::npos; };
    if (std::any_of(facts.begin(), facts.end(), named)) out.push_back(record->request.key);
  }
  return out;
}

void Reactor::try_again_later(Time now, const PlanAnswer& answer) {
  const std::string what = std::string("planner call ended as ") + to_string(answer.verdict) +
                           (answer.reason.empty() ? "" : ": " + answer.reason);
  const bool may_pass =
      answer.verdict != PlanVerdict::unsupported && answer.verdict != PlanVerdict::invalid_input;
  if (!may_pass || ++failed_calls_ > mission_->executive.call_retries) {
    make_safe(now, what);
    return;
  }
  note(NoteLevel::warning, "plan.retry", what + "; will be tried again");
  phase_ = Phase::idle;
  not_before_ = now + temporal::seconds(5.0 * static_cast<double>(1U << std::min(failed_calls_, 5U)));
  want_plan("the planner call is tried again");
  wake_at(not_before_);
}

void Reactor::make_safe(Time now, const std::string& why) {
  phase_ = Phase::safe;
  wanted_ = false;
  unsafe_ = !beliefs_.active().empty();
  Outputs cancelled = executive_.cancel_all(now);
  std::move(cancelled.commands.begin(), cancelled.commands.end(), std::back_inserter(out_.commands));
  std::move(cancelled.changes.begin(), cancelled.changes.end(), std::back_inserter(out_.steps));
  send_fallbacks(now);
  for (const GoalRecord* record : goals_.open()) {
    goals_.set_state(record->request.key, GoalState::pending, "waiting for the ground: " + why);
    out_.goal_changes.push_back(*goals_.find(record->request.key));
  }
  note(NoteLevel::error, "robot.safe", "made safe, waiting for the ground: " + why);
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
  if (phase_ == Phase::safe) return unsafe_ ? "failed" : "partial";
  if (phase_ != Phase::finished) return "";
  auto taken = goals_.all();
  std::erase_if(taken, [](const GoalRecord* record) { return record->state == GoalState::rejected; });
  const bool every_hard_goal = std::all_of(taken.begin(), taken.end(), [](const GoalRecord* record) {
    return record->request.importance != GoalClass::hard || record->state == GoalState::achieved ||
           record->state == GoalState::recalled;
  });
  return every_hard_goal && !taken.empty() ? "achieved" : "partial";
}

const char* to_string(PlanVerdict verdict) {
  switch (verdict) {
    case PlanVerdict::solved:
      return "solved";
    case PlanVerdict::unsolvable:
      return "unsolvable";
    case PlanVerdict::timeout:
      return "timeout";
    case PlanVerdict::out_of_memory:
      return "out_of_memory";
    case PlanVerdict::unsupported:
      return "unsupported";
    case PlanVerdict::function_unavailable:
      return "function_unavailable";
    case PlanVerdict::cancelled:
      return "cancelled";
    case PlanVerdict::invalid_input:
      return "invalid_input";
    case PlanVerdict::crashed:
      return "crashed";
    case PlanVerdict::no_reply:
      return "no_reply";
  }
  return "unknown";
}

const char* to_string(Phase phase) {
  switch (phase) {
    case Phase::idle:
      return "idle";
    case Phase::pausing:
      return "pausing";
    case Phase::planning:
      return "planning";
    case Phase::executing:
      return "executing";
    case Phase::safe:
      return "safe";
    case Phase::finished:
      return "finished";
  }
  return "unknown";
}

}  // namespace roci::exec
