// The planetary mission's own files, with a robot that stands at its start and has been observed.
#pragma once

#include <string>

#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/executive/messages.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::testing {

inline mission::MissionModel planetary() {
  return mission::read_mission(std::string(ROCI_SOURCE_DIR) + "/missions/planetary");
}

inline std::vector<executive::Observation> standing_robot() {
  using temporal::state;
  return {{"rover.nav", state("idle-at", {"here"})},
          {"rover.arm", state("idle-pose", {"stow"})},
          {"rover.camera", state("idle")},
          {"rover.radio", state("idle")},
          {"rover.gripper", state("empty")},
          {"rover.x", 40.0},
          {"rover.y", 40.0},
          {"rover.battery", 900000.0},
          {"comm.window", false}};
}

inline beliefs::Beliefs standing_beliefs(const mission::MissionModel& mission) {
  beliefs::Beliefs beliefs(mission);
  for (const auto& [timeline, value] : standing_robot()) beliefs.observe(timeline, value);
  return beliefs;
}

inline goals::GoalRequest photo(const std::string& id, goals::GoalClass importance = goals::GoalClass::hard,
                                double utility = 0) {
  goals::GoalRequest goal;
  goal.key = {"ground", id};
  goal.kind = "photo";
  goal.arguments = {{"x", "110"}, {"y", "60"}};
  goal.importance = importance;
  goal.utility = {utility};
  return goal;
}

}  // namespace roci::exec::testing
