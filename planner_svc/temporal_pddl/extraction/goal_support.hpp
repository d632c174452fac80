// What each activity of a plan is for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/call/named_goal.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::extraction {

/// Returns for the step of each start which goals the action serves, by index, in ascending order; nothing
/// for other steps. An action serves a goal of which it brings about a fact, and the goals of the actions that
/// use what it brings about: causal links, as in partial-order planning (McAllester and Rosenblitt 1991).
///  - A use that undoes the fact counts only where nobody else uses it: a drive to a place serves what is done
///    there, and not the drive that leaves it, unless that is all that follows.
///  - What an action takes and gives back (a camera that is idle again) it does not bring about.
///  - A number serves all later comparisons that it was moved towards.
std::vector<std::vector<std::size_t>> goals_served(const task::Task& task, const search::PlanPrefix& plan,
                                                   std::span<const call::NamedGoal> goals);

}  // namespace roci::planner::temporal_pddl::extraction
