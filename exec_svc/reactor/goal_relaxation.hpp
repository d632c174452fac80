// Goal relaxation decides which goals leave when not all fit (over-subscription planning: D. E. Smith,
// "Choosing objectives in over-subscription planning", ICAPS 2004; R52, R53). It is pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// Says what was already relaxed in the planner call that was replied to.
struct Relaxation {
  std::string soft_goals_left_out;  ///< why soft goals were left out; empty: they were not
  problem::Reserves reserves = problem::Reserves::kept;  ///< spent for hard goals, until one fails or comes

  /// Names a goal that the call was made without, since the planner refuses the problem with all of them.
  std::optional<goals::GoalKey> suspect;
  std::string refusal;  ///< what the planner said of the problem with all goals

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.soft_goals_left_out, self.reserves, self.suspect, self.refusal);
  }
};

/// Says what is relaxed next: goals that leave, or another call with less asked of it.
struct RelaxationStep {
  enum class Kind {
    give_up_soft,    ///< these goals leave
    give_up_hard,    ///< likewise; the reserves are kept back again, the goals that remain may not need them
    leave_out_soft,  ///< no goal leaves yet: one more call without the soft ones tells
    spend_reserves,  ///< no goal leaves yet: one more call may use what the mission keeps back
  };
  Kind kind = Kind::give_up_soft;
  /// Holds a goal that leaves, or would have to, and why: in the words of the mission, and in a second line, "details:
  /// …", in those of the planner.
  struct Leaving {
    goals::GoalKey goal;
    std::string reason;
  };
  std::vector<Leaving> goals;
  std::string reason;  ///< with leave_out_soft: why the soft goal would leave if the others fit without it
};

/// Returns the next step after a reply that says that the goals do not fit (temporal::speaks_of_goals). What the
/// planner proves out of reach, or cannot tell for want of a value that an owner did not find, takes no other goal with
/// it. One goal leaves at a time, unless hard ones alone are blamed: the others may be within reach once it is gone. A
/// proof that blames hard goals alone may hold only because of what the soft ones demand (a search prunes what cannot
/// serve all goals), hence leave_out_soft.
RelaxationStep relax(const PlanReply& reply, const goals::GoalSet& goals,
                     const mission::MissionModel& mission, const Relaxation& relaxed);

/// Returns the soft goal that relax() gives up, or nothing if the reply speaks of hard goals alone.
std::optional<goals::GoalKey> soft_goal_to_give_up(const PlanReply& reply, const goals::GoalSet& goals,
                                                   const Relaxation& relaxed);

/// Returns the hard goals among which some have to leave where relax() gives up hard ones: those that the planner
/// blames, else all that are open.
std::vector<goals::GoalKey> hard_goals_at_stake(const PlanReply& reply, const goals::GoalSet& goals);

/// Returns the next goal to leave out where the planner refuses a problem as invalid without naming a goal: the newest
/// one first, then each older one. Returns nothing if all were tried, or there is only one.
std::optional<goals::GoalKey> next_suspect(const goals::GoalSet& goals,
                                           const std::optional<goals::GoalKey>& suspect);

/// Returns why a goal leaves after such a reply: in the words of the mission, and behind "details: " in those of the
/// planner. Of a goal that nothing blames it claims nothing alone, but that no plan achieves all goals of the call, by
/// their names.
std::string reason_to_leave(const PlanReply& reply, const goals::GoalSet& goals,
                            const mission::MissionModel& mission, const goals::GoalKey& key,
                            const Relaxation& relaxed);

/// Returns the goals as they are, with this one counted as gone.
goals::GoalSet without(const goals::GoalSet& goals, const goals::GoalKey& key);

/// Returns the goals as they are, with open soft ones counted as gone.
goals::GoalSet hard_goals(const goals::GoalSet& goals);

}  // namespace roci::exec::reactor
