/// What a planner call that achieves not all goals means for one of them, in the words of the mission: its kind's help,
/// its arguments, the budget in mission.yaml. Pure.
#pragma once

#include <string>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// "a module works in a slot (module radar-1, slot s3)"; of a kind without help its name stands there.
std::string asked_for(const goals::GoalRequest& goal, const mission::MissionModel& mission);

/// Of a goal that the reply blames: what an owner of functions says against it; where nobody says anything, that no
/// plan brings it about. It is "out of reach" where that is proved and "not known" where a value was not found.
std::string words_of_blamed(const PlanReply& reply, const BlockingGoal& blamed,
                            const goals::GoalRequest& goal, const mission::MissionModel& mission);

/// Of a goal that leaves since the call has spent its budget: which one. `others`: the ids of the goals that were to be
/// achieved beside it; may be empty.
std::string words_of_spent_budget(const PlanReply& reply, const goals::GoalRequest& goal,
                                  const std::string& others, const mission::MissionModel& mission);

}  // namespace roci::exec::reactor
