// Reactor: plans of an engine that plans all the time (R66, R76-R81). The engine hears goals, observations
// and steps itself and sends versions of its plan; what is committed in one is executed, whatever the next
// ones say.
#include <algorithm>
#include <set>

#include "exec_svc/reactor/commitment.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using executive::Outcome;
using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalState;
using mission::Replanning;

using temporal::Time;

bool Reactor::follows_engine() const { return mission_->executive.replanning == Replanning::continuous; }

void Reactor::step_continuous(Time now, const ReactorInputs& inputs) {
  for (const temporal::PlanDelta& delta : inputs.deltas) take_delta(now, delta);
  if (phase_ == MissionPhase::executing) monitor_version(now);
  replan_wanted_ = false;  // whoever wants a plan: the engine knows
  forget_ended_plan(now);
  finish_if_done();
  report_receipt();
}

void Reactor::take_delta(Time now, const temporal::PlanDelta& delta) {
  temporal::FlexiblePlan next =
      phase_ == MissionPhase::executing ? executive_.plan() : temporal::FlexiblePlan{};
  std::string fault = fault_of(now, delta, next);
  if (fault.empty()) {
    receipt_.refused = 0;
    receipt_.reason.clear();
    adopt_version(now, std::move(next));
  } else {
    receipt_.refused = delta.added.version;
    receipt_.reason = fault;
    report(Severity::warning, "plan.refused",
           "version " + std::to_string(delta.added.version) + " is refused: " + fault);
  }
}

// Why the delta is not taken; else `next` is the plan with it.
std::string Reactor::fault_of(Time now, const temporal::PlanDelta& delta,
                              temporal::FlexiblePlan& next) const {
  if (!takes_plans()) return "the robot is not ready for a plan";
  if (delta.added.engine != mission_->planner.engine)
    return "it comes from engine '" + delta.added.engine + "', the mission's is '" +
           mission_->planner.engine + "'";
  if (delta.added.version <= plan_version_)
    return "version " + std::to_string(plan_version_) + " was known before it";
  if (std::string fault = apply(delta, next); !fault.empty()) return fault;
  if (!recovery_policy_.flexible) make_inflexible(next);
  if (const auto faults = check(next); !faults.empty()) return faults.front();
  for (const temporal::PlanActivity& activity : next.activities)
    if (std::ranges::binary_search(ended_, activity.id)) return activity.id + " has ended in the plan before";
  const bool runs = phase_ == MissionPhase::executing;
  return commitment_violation(runs ? executive_.plan() : temporal::FlexiblePlan{},
                              runs ? executive_.steps() : std::vector<StepStatus>{}, next, now);
}

void Reactor::adopt_version(Time now, temporal::FlexiblePlan plan) {
  plan_version_ = plan.version;
  plan_invalid_ = false;
  first_plan_ = false;
  executive_.load(plan, now);
  note_planned(plan);
  report(Severity::info, "plan.adopted",
         "plan " + std::to_string(plan_version_) + " with " + std::to_string(plan.activities.size()) +
             " activities");
  begin_plan(now, std::move(plan));
}

// A goal is planned while some activity serves it.
void Reactor::note_planned(const temporal::FlexiblePlan& plan) {
  std::set<std::string> served;
  for (const temporal::PlanActivity& activity : plan.activities)
    served.insert(activity.goals_served.begin(), activity.goals_served.end());
  const std::string version = std::to_string(plan.version);
  for (const GoalRecord* record : goals_.open()) {
    const GoalKey key = record->request.key;
    const bool planned = served.contains(key.text());
    if (planned == (record->state == GoalState::planned)) continue;
    goals_.set_state(key, planned ? GoalState::planned : GoalState::pending,
                     (planned ? "in plan " : "no longer in plan ") + version, plan.version);
    out_.goal_changes.push_back(*goals_.find(key));
  }
}

// A broken plan waits for the version that mends it, as long as for a planner's reply.
void Reactor::monitor_version(Time now) {
  const Outcome outcome = executive_.outcome();
  const std::string plan = "plan " + std::to_string(plan_version_);
  if (outcome.kind == OutcomeKind::broken && !plan_invalid_) {
    repair_deadline_ = now + mission_->planner.reply_timeout;
    break_plan(now, (outcome.activity.empty() ? "" : outcome.activity + ": ") + outcome.reason);
  } else if (outcome.kind == OutcomeKind::finished) {
    report(Severity::info, "plan.finished", plan + " finished");
    phase_ = MissionPhase::idle;
  } else if (plan_invalid_ && now >= repair_deadline_) {
    make_safe(now, plan + " is broken, and no other version came within " +
                       temporal::to_text(mission_->planner.reply_timeout));
  }
  if (phase_ == MissionPhase::executing && plan_invalid_) wake_at(repair_deadline_);
}

// What ended is no base for deltas: the next plan comes whole, and without what was done.
void Reactor::forget_ended_plan(Time now) {
  const OutcomeKind kind = executive_.outcome().kind;
  const bool ended = kind == OutcomeKind::finished || kind == OutcomeKind::cancelled;
  if (phase_ == MissionPhase::executing || !ended || executive_.plan().activities.empty()) return;
  ended_.clear();
  for (const StepStatus& step : executive_.steps())
    if (step.state != temporal::ActivityState::waiting) ended_.push_back(step.activity);
  std::ranges::sort(ended_);
  executive_.load({}, now);
  forward(executive_.step(now, {}));
}

bool Reactor::takes_plans() const {
  if (phase_ == MissionPhase::executing) return true;
  return executive_.outcome().kind != OutcomeKind::cancelling && beliefs_.unobserved().empty() &&
         beliefs_.active().empty();
}

void Reactor::report_receipt() {
  receipt_.version = phase_ == MissionPhase::executing ? plan_version_ : 0;
  receipt_.open = takes_plans();
  if (receipt_ == reported_receipt_) return;
  reported_receipt_ = receipt_;
  out_.receipt = receipt_;
}

}  // namespace roci::exec::reactor
