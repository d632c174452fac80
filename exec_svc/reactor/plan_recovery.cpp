#include "exec_svc/reactor/plan_recovery.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace roci::exec::reactor {

using executive::Breakage;
using executive::Outcome;
using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalSet;
using temporal::Time;

namespace {

/// Returns the goals that an activity works for: those it serves, else those of the next one that serves any.
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

PlanRecovery::PlanRecovery(MissionState& state, RunningPlan& plan, PlannerCall& call, Safing& safing)
    : state_(&state),
      plan_(&plan),
      call_(&call),
      safing_(&safing),
      policy_(recovery_policy_of(state.mission->executive.recovery)),
      backoff_(state.mission->executive.failure_limit, state.mission->executive.failure_pause,
               state.mission->executive.failure_pause_max),
      breaks_(backoff_) {}

void PlanRecovery::note_successes() {
  for (const StepStatus& step : state_->out.steps) {
    if (step.state != temporal::ActivityState::succeeded) continue;
    breaks_.succeeded(std::exchange(last_break_, {}));
    if (const auto* activity = plan_->executive().activity(step.activity)) {
      backoff_.succeeded(activity->subsystem);
      note_trust(activity->subsystem, false);
    }
  }
}

void PlanRecovery::monitor(Time now, bool next_is_coming) {
  const Outcome outcome = plan_->outcome();
  const bool all = state_->authority.level() == mission::AutonomyLevel::e4;
  const bool waits = state_->replan_wanted && !state_->replan_due();  // for the end of a hold
  if (outcome.kind == OutcomeKind::broken) {
    if (!waits || !plan_->invalid()) handle_failure(now, outcome);
  } else if (outcome.kind == OutcomeKind::finished && !next_is_coming) {
    state_->report(Severity::info, "plan.finished", plan_->name() + " finished");
    state_->phase = MissionPhase::idle;
    if (all && !state_->goals.open().empty()) state_->want_plan("the plan ended with goals open");
  } else if (outcome.kind == OutcomeKind::running && (!state_->replan_wanted || !all)) {
    if (const auto conflict = plan_->conflict_ahead(now)) {
      break_plan(now, conflict->reason);
      if (state_->replan_wanted) count_break(now, conflict->activity, "conflict");
    }
  }
}

void PlanRecovery::handle_failure(Time now, const Outcome& outcome) {
  break_plan(now, (outcome.activity.empty() ? "" : outcome.activity + ": ") + outcome.reason);
  if (!state_->replan_wanted) return;
  if (outcome.breakage == Breakage::activity_failed) {
    count_failure(now, outcome);
  } else if (outcome.breakage == Breakage::refused_for_good) {
    state_->give_up(goals_behind(plan_->executive().plan(), outcome.activity, state_->goals),
                    outcome.activity + " will never be taken: " + outcome.reason);
  } else {
    count_break(now, outcome.activity, "outcome");
  }
}

void PlanRecovery::break_plan(Time now, const std::string& reason) {
  plan_->invalidate();
  state_->report(Severity::warning, "plan.broken", plan_->name() + " is broken: " + reason);
  if (state_->authority.level() < mission::AutonomyLevel::e4)
    return safing_->make_safe(now, plan_->name() + " broke at autonomy level " +
                                       to_string(state_->authority.level()) + ": " + reason);
  if (policy_.replans) return state_->want_plan(plan_->name() + " is broken");
  if (!policy_.asks_ground)
    state_->give_up(state_->open_goals(),
                    plan_->name() + " broke, and nothing is mended in this run: " + reason);
  safing_->make_safe(now, plan_->name() + " broke: " + reason);
}

/// Counts a failure. A component that keeps failing gets ever more time to recover; in the end its goals are
/// given up.
void PlanRecovery::count_failure(Time now, const Outcome& outcome) {
  const temporal::PlanActivity* activity = plan_->executive().activity(outcome.activity);
  if (activity == nullptr || activity->subsystem.empty()) return;
  const FailureBackoff::Count count = backoff_.failed(activity->subsystem);
  if (count.used_up) {
    note_trust(activity->subsystem, true);
    state_->give_up(goals_behind(plan_->executive().plan(), outcome.activity, state_->goals),
                    activity->subsystem + " failed " + std::to_string(count.in_a_row) +
                        " times in a row, last as " + outcome.activity + " " + outcome.reason);
  } else if (count.pause > temporal::Duration{0}) {
    call_->wait_until(now + count.pause);
  }
}

void PlanRecovery::count_break(Time now, const std::string& activity, const std::string& kind) {
  const temporal::PlanActivity* broken = plan_->executive().activity(activity);
  if (broken == nullptr) return;
  std::string place = kind + " " + broken->name;
  for (const temporal::Property& argument : broken->arguments) place += " " + argument.value;
  if (place != last_break_) breaks_.succeeded(last_break_);
  last_break_ = place;
  const FailureBackoff::Count count = breaks_.failed(place);
  if (count.used_up) {
    if (!broken->subsystem.empty()) note_trust(broken->subsystem, true);
    state_->give_up(goals_behind(plan_->executive().plan(), activity, state_->goals),
                    std::to_string(count.in_a_row) + " plans in a row broke at " + broken->name +
                        ", with nothing done in between");
  } else if (count.pause > temporal::Duration{0}) {
    call_->wait_until(now + count.pause);
  }
}

void PlanRecovery::note_trust(const std::string& subsystem, bool lost) {
  const std::string timeline = std::string(kTrust) + subsystem;
  const auto value = lost ? std::optional<temporal::Value>(temporal::state("lost")) : std::nullopt;
  if (state_->beliefs.conclude(timeline, value))
    state_->out.concluded.push_back({timeline, value.value_or(temporal::Value{})});
}

bool PlanRecovery::may_replan(Time now) {
  const std::uint32_t limit = state_->mission->executive.replan_limit;
  if (plan_->version() == 0 || ++state_->counts.replans <= limit) return true;
  safing_->make_safe(now, "the limit of " + std::to_string(limit) +
                              " replans is reached; the last: " + state_->replan_reason);
  return false;
}

}  // namespace roci::exec::reactor
