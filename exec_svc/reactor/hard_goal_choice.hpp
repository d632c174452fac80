/// Which hard goals give way when not even those all fit: the fewest whose leaving leaves a plan for the
/// others (B2). The planner says of each set whether it does, a call each (over-subscription planning:
/// D. E. Smith, "Choosing objectives in over-subscription planning", ICAPS 2004). Pure.
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

/// Hard goals among which some have to leave, and how far it has been seen which.
struct HardGoalTrials {
  /// The newest call was made without these; with none there are no trials.
  std::vector<goals::GoalKey> without;
  std::uint32_t made = 0;  ///< calls, the newest one with them
  PlanReply refusal;       ///< to the call with all hard goals

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.without, self.made, self.refusal);
  }
};

/// The goals that the next trial is to be made without; empty: all sets, or as many as `most`, were tried.
std::vector<goals::GoalKey> next_trial(const goals::GoalSet& goals, const std::vector<goals::GoalKey>& among,
                                       std::uint32_t made, std::uint32_t most);

/// Why a goal leaves that a trial was made without: what the planner said of all goals, and that it has a plan
/// of the others.
std::string with_what_it_saves(const std::string& reason);

}  // namespace roci::exec::reactor
