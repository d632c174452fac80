// This file chooses which hard goals give way when not even those all fit: the fewest whose leaving leaves a
// plan for the others (B2). Whether a set does is found by one planner call each (over-subscription planning:
// D. E. Smith, "Choosing objectives in over-subscription planning", ICAPS 2004). It is pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/reactor/goal_relaxation.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// The sets of these hard goals that might leave, in the order in which they are tried: smaller ones first, of
/// equally many goals those of the least utility in all by rank, of equal utility as goals::leaves_first() says. At
/// most `most`; never none or all of the goals, and no set of a size of which there are more than 10,000.
std::vector<std::vector<goals::GoalKey>> leaving_sets(const goals::GoalSet& goals,
                                                      const std::vector<goals::GoalKey>& among,
                                                      std::size_t most);

/// Holds how far the trials have come that find which hard goals leave.
struct HardGoalTrials {
  /// Lists the goals that the newest call was made without; if it is empty, there are no trials.
  std::vector<goals::GoalKey> without;
  std::uint32_t made = 0;  ///< number of calls, the newest one included
  PlanReply refusal;       ///< reply to the call with all hard goals

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.without, self.made, self.refusal);
  }
};

/// Returns the goals that the next trial is to leave out, or none if all sets, or as many as `most`, were
/// tried.
std::vector<goals::GoalKey> next_trial(const goals::GoalSet& goals, const std::vector<goals::GoalKey>& among,
                                       std::uint32_t made, std::uint32_t most);

/// Returns why a goal leaves that a successful trial left out: what the planner said of all goals, and that it
/// has a plan for the others.
std::string with_what_it_saves(const std::string& reason);

}  // namespace roci::exec::reactor
