#include "exec_svc/reactor/running_plan.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/temporal/function_values.hpp"
#include "core/temporal/schedule.hpp"
#include "exec_svc/reactor/inputs.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"
#include "exec_svc/reactor/relaunch.hpp"

namespace roci::exec::reactor {

using executive::Inputs;
using executive::Observation;
using executive::OutcomeKind;
using executive::Outputs;
using executive::RecoveryAction;
using executive::RecoveryStep;
using executive::StepStatus;
using temporal::Time;

namespace {

const char* code_of(RecoveryAction action) {
  switch (action) {
    case RecoveryAction::push:
      return "recovery.push";
    case RecoveryAction::retry:
      return "recovery.retry";
    case RecoveryAction::contingency:
      break;
  }
  return "recovery.contingency";
}

/// Counts the activities whose windows are reported when they move: what a screen shows, without work in the
/// size of the plan.
constexpr std::size_t kReportedAhead = 32;

/// Bounds the activities that one event names.
constexpr std::size_t kNamedActivities = 5;

bool under_way(const StepStatus& step) {
  const bool begun =
      step.state == temporal::ActivityState::dispatched || step.state == temporal::ActivityState::running;
  return begun && step.attempt <= 1;
}

temporal::FlexiblePlan in_order_of_starts(const temporal::FlexiblePlan& plan) {
  temporal::FlexiblePlan out = plan;
  const auto times = temporal::earliest_schedule(plan.point_count, temporal::all_constraints(plan));
  if (!times) return out;
  std::ranges::stable_sort(out.activities, {}, [&](const temporal::PlanActivity& activity) {
    return (*times)[activity.start_point];
  });
  return out;
}

}  // namespace

RunningPlan::RunningPlan(MissionState& state)
    : state_(&state), executive_(executive_settings(*state.mission)) {}

void RunningPlan::step(Time now, const ReactorInputs& inputs) {
  Inputs told;
  tell_observed(inputs.observations, told);
  for (Observation& change : changed_conditions()) {
    conflict_monitor_.observe(change.timeline, change.value);
    told.observations.push_back(std::move(change));
  }
  if (inputs.epoch != 0) epoch_ = inputs.epoch;
  told.epoch = epoch_;
  told.acks = inputs.acks;
  for (const PeerLoss& loss : inputs.losses) told.lost_owners.push_back(loss.service);
  if (state_->mission->executive.owner_return > temporal::Duration(0)) told.found_owners = inputs.arrivals;
  told.answers = std::exchange(answers_, {});
  Outputs done = executive_.step(now, told);
  answer_results_ = std::move(done.answers);
  const auto lookup = [this](const std::string& timeline) { return state_->beliefs.lookup(timeline); };
  for (const StepStatus& step : done.changes) {
    conflict_monitor_.change(step.activity, step.state);
    if (step.state != temporal::ActivityState::waiting) resource_monitor_.remove(step.activity);
    if (under_way(step)) resource_monitor_.begin(step.activity);
    if (step.ended) resource_monitor_.end(step.activity, lookup);
  }
  for (const RecoveryStep& recovery : done.recoveries) {
    if (recovery.action == RecoveryAction::retry) resource_monitor_.charge_again(recovery.activity, lookup);
    state_->report(Severity::info, code_of(recovery.action), recovery.activity + ": " + recovery.reason);
  }
  for (const executive::CommandAck& ack : inputs.acks) record_.note(ack);
  forward(std::move(done), now);
  close_record();
  if (!state_->out.steps.empty() && state_->phase == MissionPhase::executing) report_windows();
}

// Concludes values of timelines from activities without a command, which nobody else can tell. Each value counts,
// also one that the next activity changes at the same time.
void RunningPlan::conclude(const std::vector<StepStatus>& changes, Time now) {
  for (const StepStatus& step : changes) {
    const temporal::PlanActivity* const activity = executive_.activity(step.activity);
    if (activity == nullptr || !activity->owner.empty() || !step.started) continue;
    const bool succeeded = step.state == temporal::ActivityState::succeeded;
    bool news = false;
    const auto note = [&](const std::string& timeline, const std::optional<temporal::Value>& value) {
      if (!state_->beliefs.conclude(timeline, value)) return;
      news = true;
      if (state_->tells_conclusion(timeline))
        state_->out.concluded.push_back({timeline, value.value_or(temporal::Value{})});
    };
    for (const temporal::Impact& impact : activity->impacts) {
      if (impact.kind != temporal::ImpactKind::assign) continue;
      if (step.ended && !succeeded) {  // what lasted gives way to the value before it
        note(impact.timeline, executive_.value_of(impact.timeline));
      } else if ((impact.moment == temporal::ImpactWhen::at_end) == succeeded) {
        note(impact.timeline, impact.amount);
      }
    }
    if (news) note_achieved(*state_, now);
  }
}

void RunningPlan::resume(Time now) { forward(executive_.resume(now), now); }

void RunningPlan::cancel(Time now) { forward(executive_.cancel_all(now), now); }

std::string RunningPlan::load(temporal::FlexiblePlan plan, Time now) {
  const auto faults = executive_.load(plan, now);
  if (!faults.empty()) return faults.front();
  version_ = plan.version;
  invalid_ = false;
  watch(plan);
  if (record_.open() && !state_->mission->executive.plans_continuously())
    close(ExecutedOutcome::replaced, "");
  record_.begin(plan);
  return "";
}

void RunningPlan::close(ExecutedOutcome outcome, std::string reason) {
  last_executed_ = record_.close(outcome, std::move(reason));
  state_->out.executed = last_executed_;
}

// Closes the record; a broken plan is over when nothing of it runs any more.
void RunningPlan::close_record() {
  if (!record_.open()) return;
  const executive::Outcome outcome = executive_.outcome();
  const auto active = [](const StepStatus& step) {
    return step.state == temporal::ActivityState::dispatched ||
           step.state == temporal::ActivityState::running;
  };
  if (outcome.kind == OutcomeKind::finished) {
    close(ExecutedOutcome::finished, "");
  } else if (outcome.kind == OutcomeKind::cancelled) {
    close(ExecutedOutcome::cancelled, outcome.reason);
  } else if (outcome.kind == OutcomeKind::broken && std::ranges::none_of(executive_.steps(), active)) {
    close(ExecutedOutcome::broken, outcome.reason);
  }
}

/// Sets up the monitors. An engine that plans all the time sends activities in any order and changes a plan
/// of which a part has happened; a planner's plan comes in the order of its starts, and all of it waits.
void RunningPlan::watch(const temporal::FlexiblePlan& plan, bool launched_again) {
  const mission::MissionModel& mission = *state_->mission;
  std::set<std::string> predicted;
  for (const mission::WindowModel& window : mission.windows)
    predicted.insert(mission.has_domain() ? window.fact : window.timeline);
  predicted.insert(mission.ground.values.begin(),
                   mission.ground.values.end());  // the ground may still set them
  const bool new_version = mission.executive.plans_continuously() || launched_again;
  const temporal::FlexiblePlan watched = new_version ? in_order_of_starts(plan) : plan;
  ConflictMonitor conflicts(watched, predicted, mission.executive.ack_timeout);
  resource_monitor_ = ResourceMonitor(watched);
  if (new_version) {
    conflicts.continue_from(conflict_monitor_);
    for (const StepStatus& step : executive_.steps()) {
      conflicts.change(step.activity, step.state);
      if (step.state != temporal::ActivityState::waiting) resource_monitor_.remove(step.activity);
      if (under_way(step)) resource_monitor_.begin(step.activity);
    }
  }
  conflict_monitor_ = std::move(conflicts);
}

void RunningPlan::drop(const std::string& activity, const std::string& reason) {
  for (const std::string& left : left_out(executive_.plan(), executive_.steps(), {activity}))
    executive_.drop(left, reason);
}

std::string RunningPlan::drop_fault(const std::set<std::string>& dropped) const {
  return reactor::drop_fault(executive_.plan(), executive_.steps(), dropped);
}

std::string RunningPlan::relaunch(Time now, const std::set<std::string>& dropped) {
  temporal::FlexiblePlan plan = executive_.plan();
  const std::vector<StepStatus> steps = executive_.steps();
  const std::set<std::string> without = left_out(plan, steps, dropped);
  if (std::string fault = relaunch_fault(plan, steps, without, now); !fault.empty()) return fault;
  plan.version = ++version_;
  executive_.load_again(plan, now);
  invalid_ = false;
  for (const std::string& activity : without) executive_.drop(activity, "left out by the relaunch");
  watch(plan, true);
  record_.begin(plan);
  for (const StepStatus& step : executive_.steps()) record_.note(step);
  begin(now);
  return "";
}

StepStatus RunningPlan::step_of(const std::string& activity) const {
  const std::vector<StepStatus> steps = executive_.steps();
  return *std::ranges::find(steps, activity, &StepStatus::activity);
}

void RunningPlan::begin(Time now) {
  state_->phase = MissionPhase::executing;
  condition_values_.clear();
  for (const temporal::PlanActivity& activity : executive_.plan().activities) {
    for (const temporal::Condition* condition : {&activity.pre, &activity.maintenance}) {
      for (const std::string& name : temporal::timelines_of(*condition)) condition_values_[name] = {};
    }
  }
  for (const temporal::DecisionPoint& decision : executive_.plan().decisions) {
    for (const temporal::DecisionChoice& choice : decision.choices) {
      for (const std::string& name : temporal::timelines_of(choice.rule)) condition_values_[name] = {};
    }
  }
  state_->out.adopted = executive_.plan();
  reported_starts_.clear();
  report_windows();
  state_->wake_at(now);
}

std::string RunningPlan::take_over(temporal::FlexiblePlan plan, Time now) {
  if (std::string fault = load(std::move(plan), now); !fault.empty()) return fault;
  keep_actions({});
  for (const StepStatus& step : executive_.steps()) record_.note(step);
  begin(now);
  return "";
}

void RunningPlan::unload(Time now) {
  executive_.load({}, now);
  forward(executive_.step(now, {}), now);
}

std::optional<ConflictAhead> RunningPlan::conflict_ahead(Time now) {
  const auto lookup = [this](const std::string& timeline) { return state_->beliefs.lookup(timeline); };
  if (const auto conflict = resource_monitor_.conflict(lookup))
    return ConflictAhead{conflict->activity, conflict->activity + " will lack " + conflict->description};
  if (const auto conflict = conflict_monitor_.conflict(now)) {
    const auto steps = executive_.steps();
    const auto due = std::ranges::find(steps, conflict->activity, &StepStatus::activity);
    return ConflictAhead{conflict->activity, conflict->activity + ", due at " +
                                                 temporal::to_text(due->earliest_start) + ", will lack " +
                                                 conflict->description +
                                                 ", and nothing in the plan brings it about"};
  }
  if (const auto next = conflict_monitor_.next_check()) state_->wake_at(*next);
  return std::nullopt;
}

void RunningPlan::note_newer(const ModelVersion& model) {
  if (state_->phase != MissionPhase::executing) return;
  const auto& values = executive_.plan().function_values;
  const auto is_older = [&](std::size_t i) {
    return values[i].owner == model.owner && values[i].model_version < model.version;
  };
  std::set<std::uint64_t> versions;
  std::string names;
  std::size_t count = 0;
  for (const PlannedAction& action : remaining()) {
    auto used = temporal::function_values_of(action.arguments, values);
    std::erase_if(used, [&](std::size_t i) { return !is_older(i); });
    if (used.empty()) continue;
    for (const std::size_t i : used) versions.insert(values[i].model_version);
    if (++count <= kNamedActivities) names += (count == 1 ? "" : ", ") + action.activity;
  }
  if (count == 0) return;
  if (count > kNamedActivities) names += " and " + std::to_string(count - kNamedActivities) + " more";
  std::string before;
  for (const std::uint64_t version : versions)
    before += (before.empty() ? "" : ", ") + std::to_string(version);
  state_->report(Severity::info, "values.outdated",
                 name() + " stands on values of an older model: " + model.owner + " has version " +
                     std::to_string(model.version) + " now, the values of " + names + " are of version " +
                     before);
}

std::vector<PlannedAction> RunningPlan::remaining() const {
  return remaining_actions(planned_, executive_.steps());
}

void RunningPlan::restore_observations(const std::vector<Observation>& observations) {
  Inputs observed;
  tell_observed(observations, observed);
  executive_.step(Time{0}, observed);
}

void RunningPlan::restore_concluded(const std::map<std::string, temporal::Value>& concluded) {
  Inputs known;
  for (const auto& [timeline, value] : concluded) known.settings.push_back({timeline, value});
  executive_.step(Time{0}, known);
}

/// Passes observations on. A value that the ground sets is observed by nobody: it holds until an activity
/// changes it.
void RunningPlan::tell_observed(const std::vector<Observation>& observations, Inputs& told) const {
  for (const Observation& one : observations)
    (is_set_by_ground(one.timeline) ? told.settings : told.observations).push_back(one);
}

bool RunningPlan::is_set_by_ground(const std::string& timeline) const {
  const auto& values = state_->mission->ground.values;
  return std::ranges::find(values, timeline) != values.end();
}

/// Derives facts from observations, since the metadata are here; the executive sees each as one more
/// timeline.
std::vector<Observation> RunningPlan::changed_conditions() {
  std::vector<Observation> out;
  for (auto& [name, last] : condition_values_) {
    if (is_set_by_ground(name)) continue;  // it is told when it is set
    auto value = state_->beliefs.lookup(name);
    if (!value || *value == last) continue;
    last = *value;
    out.push_back({name, std::move(*value)});
  }
  return out;
}

void RunningPlan::forward(Outputs done, Time now) {
  conclude(done.changes, now);
  end_approvals(done.changes);
  ReactorOutputs& out = state_->out;
  std::move(done.commands.begin(), done.commands.end(), std::back_inserter(out.commands));
  for (const StepStatus& step : done.changes) record_.note(step);
  std::move(done.changes.begin(), done.changes.end(), std::back_inserter(out.steps));
  for (executive::DecisionStatus& decision : done.decisions)
    out.decisions.push_back({std::move(decision), version_});
  if (done.next_wake) state_->wake_at(*done.next_wake);
}

/// Withdraws the approvals of what has begun, or will not begin any more.
void RunningPlan::end_approvals(const std::vector<StepStatus>& changes) {
  bool fewer = false;
  for (const StepStatus& step : changes)
    if (step.state != temporal::ActivityState::waiting)
      fewer = state_->authority.withdraw_approval(step.activity) || fewer;
  if (fewer) permit(state_->authority.permissions());
}

/// Reports the windows of what starts next again where real events have moved them.
void RunningPlan::report_windows() {
  for (const StepStatus& step : executive_.upcoming(kReportedAhead)) {
    const auto [reported, added] = reported_starts_.try_emplace(step.activity, step.earliest_start);
    if (!added && reported->second == step.earliest_start) continue;
    reported->second = step.earliest_start;
    state_->out.steps.push_back(step);
  }
}

}  // namespace roci::exec::reactor
