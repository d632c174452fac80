// The planning cycle leads from a wish for a plan to a plan that runs.
#pragma once

#include "exec_svc/reactor/goal_relaxation.hpp"
#include "exec_svc/reactor/hard_goal_choice.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

/// Writes the problem, calls the planner, and turns its reply into a plan, into fewer goals or into another
/// call.
class PlanningCycle {
 public:
  /// All arguments must outlive this object.
  PlanningCycle(MissionState& state, RunningPlan& plan, PlannerCall& call, Safing& safing)
      : state_(&state), plan_(&plan), call_(&call), safing_(&safing) {}

  /// Calls the planner for the state that is observed; without open goals there is nothing to plan.
  void begin(temporal::Time now);
  /// Calls the planner for a plan that starts at `origin`, when the forecast has come about.
  void call(temporal::Time now, temporal::Time origin, const problem::Forecast& forecast);
  /// Acts on the reply to a call that begin() made.
  void take_reply(temporal::Time now, const PlanReply& reply);
  /// Binds the plan to its commands and runs it. A plan that cannot be executed makes the robot safe. A plan without
  /// activities says that all goals hold already: it is adopted for a goal once, since an observation may follow, and
  /// the second time the goal is given up.
  void adopt(temporal::Time now, const PlanReply& reply);

  /// Acts on a reply that says that not all goals fit: one leaves, or the next call is relaxed. Returns false
  /// if that call is to be made at once, for hard goals alone or for some of them.
  bool relax(const PlanReply& reply);
  /// Returns whether relax() would end a soft goal, with no hard one at stake.
  bool soft_goal_would_leave(const PlanReply& reply) const;
  /// Doubts a reply that goals are out of reach if a source of observations was away: no goal is to end for that.
  /// Reports it, and sets the time before which the call is not to be repeated (PlannerCall). Returns false if the
  /// reply counts, also after enough such replies.
  bool doubts(temporal::Time now, const PlanReply& reply);
  /// Keeps the mission's reserves back again, since another goal came.
  void keep_reserves() { relaxed_.reserves = problem::Reserves::kept; }

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    Relaxation::fields(archive, self.relaxed_);
    HardGoalTrials::fields(archive, self.trials_);
    archive(self.planned_without_activities_);
  }

 private:
  void call_for_now(temporal::Time now);
  problem::Problem write(temporal::Time now, temporal::Time origin, const problem::Forecast& forecast) const;
  /// Reports what the problem leaves out, and ends the goals that make it invalid. Returns whether there were
  /// such goals.
  bool leave_out(const problem::Problem& problem);
  /// Asks the planner, which calls the problem invalid, again without one goal, then without another one. Returns
  /// false if it is none of them.
  bool suspect_a_goal(temporal::Time now, const PlanReply& reply);
  /// Asks the planner without some of the hard goals, since not even those fit, to find which have to leave.
  /// Returns false if the mission does not want that, or there is nothing more to try.
  bool try_without_some(const PlanReply& refusal);
  /// Acts on the reply to such a trial: the goals that it left out leave, or the next set is tried, or all goals
  /// leave that would have left without trials.
  void take_trial(temporal::Time now, const PlanReply& reply);
  void give_up_hard(const RelaxationStep& step);
  void try_again_later(temporal::Time now, const PlanReply& reply);
  void tell_retry(const std::string& reason);
  void await_retry();
  void note_planned();
  /// Sets start times beyond what the plan asks for: fixed ones at E2, the latest where the mission says so.
  void set_start_times(temporal::FlexiblePlan& plan) const;
  /// Ends the goals for which a plan without activities was adopted before, with nothing achieved by it. Returns
  /// whether there were such goals.
  bool give_up_unseen();

  MissionState* state_;
  RunningPlan* plan_;
  PlannerCall* call_;
  Safing* safing_;
  Relaxation relaxed_;  ///< what the newest call relaxed
  HardGoalTrials trials_;
  /// Lists the goals of the newest plan if that has no activities.
  std::vector<goals::GoalKey> planned_without_activities_;
};

}  // namespace roci::exec::reactor
