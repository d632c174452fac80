#include "exec_svc/reactor/continuous_planning.hpp"

#include <algorithm>
#include <set>

#include "exec_svc/reactor/commitment.hpp"
#include "exec_svc/reactor/message_fields.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"

namespace roci::exec::reactor {

using executive::Outcome;
using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalRecord;
using goals::GoalState;
using temporal::FlexiblePlan;
using temporal::Time;

void ContinuousPlanning::step(Time now, const ReactorInputs& inputs) {
  for (const temporal::PlanDelta& delta : inputs.deltas) take_delta(now, delta);
  if (parts_.state.phase == MissionPhase::executing && !end_with_goals(now)) monitor(now);
  parts_.state.replan_wanted = false;  // whoever wants a plan: the engine knows
  forget_ended_plan(now);
  report_receipt();
}

void ContinuousPlanning::take_delta(Time now, const temporal::PlanDelta& delta) {
  const bool runs = parts_.state.phase == MissionPhase::executing;
  FlexiblePlan next = runs ? parts_.plan.executive().plan() : FlexiblePlan{};
  const std::string fault = fault_of(now, delta, next);
  if (fault.empty()) {
    receipt_.refused = 0;
    receipt_.reason.clear();
    adopt_version(now, std::move(next));
  } else {
    receipt_.refused = delta.added.version;
    receipt_.reason = fault;
    parts_.state.report(Severity::warning, "plan.refused",
                        "version " + std::to_string(delta.added.version) + " is refused: " + fault);
  }
}

/// Returns why the delta is not taken; else `next` is the plan with it.
std::string ContinuousPlanning::fault_of(Time now, const temporal::PlanDelta& delta,
                                         FlexiblePlan& next) const {
  const mission::MissionModel& mission = *parts_.state.mission;
  if (!takes_plans()) return "the robot is not ready for a plan";
  if (parts_.state.phase == MissionPhase::executing &&
      parts_.state.authority.level() != mission::AutonomyLevel::e4)
    return std::string("the running plan stays as it is at autonomy level ") +
           to_string(parts_.state.authority.level());
  if (delta.added.engine != mission.planner.engine)
    return "it comes from engine '" + delta.added.engine + "', the mission's is '" + mission.planner.engine +
           "'";
  if (delta.added.version <= parts_.plan.version())
    return "version " + std::to_string(parts_.plan.version()) + " was known before it";
  if (std::string fault = apply(delta, next); !fault.empty()) return fault;
  if (!recovery_policy_of(mission.executive.recovery).flexible) make_inflexible(next);
  if (const auto faults = check(next); !faults.empty()) return faults.front();
  for (const temporal::PlanActivity& activity : next.activities)
    if (std::ranges::binary_search(ended_activities_, activity.id))
      return activity.id + " has ended in the plan before";
  const executive::Executive& executive = parts_.plan.executive();
  const bool runs = parts_.state.phase == MissionPhase::executing;
  return commitment_violation(runs ? executive.plan() : FlexiblePlan{},
                              runs ? executive.steps() : std::vector<StepStatus>{}, next, now);
}

void ContinuousPlanning::adopt_version(Time now, FlexiblePlan plan) {
  parts_.plan.load(plan, now);
  conflicting_activity_.clear();  // this version may still have it
  receipt_.conflict.clear();
  note_planned(plan);
  parts_.state.report(Severity::info, "plan.adopted",
                      parts_.plan.name() + " with " + std::to_string(plan.activities.size()) + " activities");
  parts_.plan.begin(now);
}

/// Marks goals as planned while some activity serves them.
void ContinuousPlanning::note_planned(const FlexiblePlan& plan) {
  std::set<std::string> served;
  for (const temporal::PlanActivity& activity : plan.activities)
    served.insert(activity.goals_served.begin(), activity.goals_served.end());
  const std::string version = std::to_string(plan.version);
  for (const GoalRecord* record : parts_.state.goals.open()) {
    const goals::GoalKey key = record->request.key;
    const bool planned = served.contains(key.text());
    if (planned == (record->state == GoalState::planned)) continue;
    parts_.state.set_goal(key, planned ? GoalState::planned : GoalState::pending,
                          (planned ? "in plan " : "no longer in plan ") + version, plan.version);
  }
}

/// Ends the plan, once no goal is open any more, with the commands that run or are committed. Activities without a
/// command, such as a load that is always on or a wait for the ground, would keep the mission open for as long as they
/// were planned. So would a command behind such a wait, or one that waits for what never comes, as with an empty
/// battery: none is awaited for longer than a fallback after its planned start. Returns whether the plan has ended.
bool ContinuousPlanning::end_with_goals(Time now) {
  MissionState& state = parts_.state;
  if (state.goals.all().empty() || !state.goals.open().empty()) return false;
  const executive::Executive& executive = parts_.plan.executive();
  const auto is_to_come = [&](const StepStatus& step) {
    const temporal::PlanActivity& activity = *executive.activity(step.activity);
    const bool waits = step.state == temporal::ActivityState::waiting;
    const Time awaited_until =
        temporal::plus(temporal::plus(executive.plan().origin, activity.preferred_start),
                       state.mission->executive.fallback_timeout);
    const bool will_start = activity.commit == temporal::CommitState::committed && now < awaited_until &&
                            executive.outcome().kind == OutcomeKind::running;
    if (waits && will_start && temporal::bounded(awaited_until)) state.wake_at(awaited_until);
    return !activity.owner.empty() && !temporal::is_over(step.state) && (!waits || will_start);
  };
  if (std::ranges::any_of(executive.steps(), is_to_come)) return true;
  state.report(Severity::info, "plan.finished", parts_.plan.name() + " ends: no goal is open any more");
  parts_.plan.cancel(now);
  state.phase = MissionPhase::idle;
  return true;
}

void ContinuousPlanning::monitor(Time now) {
  MissionState& state = parts_.state;
  const Outcome outcome = parts_.plan.outcome();
  if (outcome.kind == OutcomeKind::broken && !parts_.plan.invalid()) {
    await_repair(now, (outcome.activity.empty() ? "" : outcome.activity + ": ") + outcome.reason);
  } else if (outcome.kind == OutcomeKind::finished) {
    state.report(Severity::info, "plan.finished", parts_.plan.name() + " finished");
    state.phase = MissionPhase::idle;
  } else if (parts_.plan.invalid() && now >= repair_deadline_) {
    parts_.safing.make_safe(now, parts_.plan.name() + " is broken, and no other version came within " +
                                     temporal::to_text(state.mission->planner.reply_timeout));
  } else if (outcome.kind == OutcomeKind::running && !parts_.plan.invalid()) {
    check_ahead(now);
  }
  if (state.phase == MissionPhase::executing && parts_.plan.invalid()) state.wake_at(repair_deadline_);
}

/// Waits for the version that repairs a broken plan, as long as for a planner's reply. Nothing new starts.
void ContinuousPlanning::await_repair(Time now, const std::string& reason) {
  repair_deadline_ = now + parts_.state.mission->planner.reply_timeout;
  parts_.plan.hold_starts(true);
  parts_.recovery.break_plan(now, reason);
}

/// Tells the engine of a conflict once, in words that stay as long as it concerns the same activity.
void ContinuousPlanning::check_ahead(Time now) {
  const auto conflict = parts_.plan.conflict_ahead(now);
  const std::string activity = conflict ? conflict->activity : "";
  if (activity == conflicting_activity_) return;
  conflicting_activity_ = activity;
  receipt_.conflict = conflict ? conflict->reason : "";
  if (!conflict) return;
  const temporal::PlanActivity* planned = parts_.plan.executive().activity(activity);
  if (planned->commit == temporal::CommitState::committed) return await_repair(now, conflict->reason);
  parts_.state.report(Severity::info, "plan.conflict",
                      parts_.plan.name() + ": " + conflict->reason + "; the engine is told");
}

/// Forgets a plan that has ended, which is no base for deltas: the next plan comes whole, without what was
/// done.
void ContinuousPlanning::forget_ended_plan(Time now) {
  const executive::Executive& executive = parts_.plan.executive();
  const OutcomeKind kind = executive.outcome().kind;
  const bool ended = kind == OutcomeKind::finished || kind == OutcomeKind::cancelled;
  if (parts_.state.phase == MissionPhase::executing || !ended || executive.plan().activities.empty()) return;
  if (waits_for_ground()) return;  // it may be launched again
  ended_activities_.clear();
  for (const StepStatus& step : executive.steps())
    if (step.state != temporal::ActivityState::waiting) ended_activities_.push_back(step.activity);
  std::ranges::sort(ended_activities_);
  parts_.plan.unload(now);
}

bool ContinuousPlanning::takes_plans() const {
  const MissionState& state = parts_.state;
  if (state.phase == MissionPhase::executing) return true;
  if (waits_for_ground()) return false;
  return parts_.plan.outcome().kind != OutcomeKind::cancelling && state.beliefs.unobserved().empty() &&
         state.beliefs.active().empty();
}

bool ContinuousPlanning::waits_for_ground() const {
  return parts_.state.phase == MissionPhase::safe && !parts_.state.authority.may_replan();
}

void ContinuousPlanning::report_receipt() {
  receipt_.version = parts_.state.phase == MissionPhase::executing ? parts_.plan.version() : 0;
  if (receipt_.version == 0) receipt_.conflict.clear();
  receipt_.open = takes_plans();
  if (receipt_ == reported_receipt_) return;
  reported_receipt_ = receipt_;
  parts_.state.out.receipt = receipt_;
}

void ContinuousPlanning::save(archive::Writer& archive) const {
  archive(receipt_, reported_receipt_, conflicting_activity_, repair_deadline_, ended_activities_);
}

void ContinuousPlanning::restore(archive::Reader& archive) {
  archive(receipt_, reported_receipt_, conflicting_activity_, repair_deadline_, ended_activities_);
}

}  // namespace roci::exec::reactor
