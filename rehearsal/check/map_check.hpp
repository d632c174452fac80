// This file checks the map of a mission against what the mission places on it.
#pragma once

#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of objects of an executive that lie outside the map: where `site` is read, x and y of an object are metres
/// of the map's frame. (That the map can be read, and that robots start on it, is told by the readers that fly.)
void check_objects_on_map(const CheckedMission& mission, const CheckedExecutive& executive);

/// Complains of goals of a scenario that ask for a place outside the map, unless the scenario expects that a goal is
/// given up, and warns of rocks and obstacles there, which nobody meets.
void check_scenario_on_map(const CheckedMission& mission, const CheckedScenario& scenario,
                           mission::Findings& findings);

}  // namespace roci::rehearsal::check
