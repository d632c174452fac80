/// From a wish for a plan to a plan that runs: the problem is written, the planner called, and its reply
/// turned into a plan, into fewer goals or into another call.
#pragma once

#include "exec_svc/reactor/goal_relaxation.hpp"
#include "exec_svc/reactor/hard_goal_choice.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

class PlanningCycle {
 public:
  /// All outlive this.
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

  /// Not all goals fit: one leaves, or the next call is relaxed. False: that call is to be made as it is, for
  /// hard goals alone or for some of them.
  bool relax(const PlanReply& reply);
  /// Whether relax() would end a soft goal, and no hard one is at stake.
  bool soft_goal_would_leave(const PlanReply& reply) const;
  /// The planner says that goals are out of reach, and was asked while somebody was away who tells what is so: no goal
  /// is to end for that. Tells it, and sets the time before which the call is not to be made again (PlannerCall).
  /// False: the reply counts, also where it has been asked often enough.
  bool doubts(temporal::Time now, const PlanReply& reply);
  /// Another goal came: what the mission keeps back is kept again.
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
  /// Says what the problem does without, and ends the goals that make it invalid. True: there were such goals.
  bool leave_out(const problem::Problem& problem);
  /// The planner calls the problem invalid: it is asked again without one goal, then without another one. False: it is
  /// none of them.
  bool suspect_a_goal(temporal::Time now, const PlanReply& reply);
  /// Not even the hard goals fit: the planner is asked without some of them, to see which ones' leaving saves the
  /// others. False: the mission does not want that, or there is nothing more to try.
  bool try_without_some(const PlanReply& refusal);
  /// Acts on the reply to such a call: what it was made without leaves, or is tried again with the next ones, or all
  /// leave that would have left at once.
  void take_trial(temporal::Time now, const PlanReply& reply);
  void give_up_hard(const RelaxationStep& step);
  void try_again_later(temporal::Time now, const PlanReply& reply);
  void tell_retry(const std::string& reason);
  void await_retry();
  void note_planned();
  /// Times of the starts beyond what the plan asks for: fixed ones at E2, the latest where the mission says so.
  void set_start_times(temporal::FlexiblePlan& plan) const;
  /// Ends the goals for which a plan without activities was adopted before, with nothing achieved by it. True: there
  /// were such goals.
  bool give_up_unseen();

  MissionState* state_;
  RunningPlan* plan_;
  PlannerCall* call_;
  Safing* safing_;
  Relaxation relaxed_;  ///< in the newest call
  HardGoalTrials trials_;
  /// The goals of the newest plan if that has no activities.
  std::vector<goals::GoalKey> planned_without_activities_;
};

}  // namespace roci::exec::reactor
