// The problem writer writes problems from observations and goals: one code path for planning and replanning
// (R42). The mission's model never changes (R8); everything that does change stands here.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

/// Writes the problem of now. `origin` is the mission time that the problem calls 0; windows that ended
/// before it are left out.
Problem write_problem(const mission::MissionModel& mission, const beliefs::Beliefs& beliefs,
                      const goals::GoalSet& goals, const std::string& name, temporal::Time now,
                      temporal::Time origin, Reserves reserves = Reserves::kept,
                      const Forecast& forecast = {});

/// Returns the goal's PDDL conditions, mostly facts; none without a domain.
std::vector<std::string> goal_facts(const mission::MissionModel& mission, const goals::GoalRequest& goal);

/// Returns whether what was observed achieves the goal: the condition of its kind holds, or else all of its facts do.
/// It must not be asked of kinds that are judged on everything that is known (GoalKind::formula).
bool is_achieved(const mission::MissionModel& mission, const beliefs::Beliefs& beliefs,
                 const goals::GoalRequest& goal);

/// Returns the same for every kind. A formula holds if it holds at the beginning of a problem written now, so that
/// planner and executive never differ on it; none holds while a component has not been observed.
bool is_achieved(const mission::MissionModel& mission, const beliefs::Beliefs& beliefs,
                 const goals::GoalSet& goals, const goals::GoalRequest& goal, temporal::Time now);

}  // namespace roci::exec::problem
