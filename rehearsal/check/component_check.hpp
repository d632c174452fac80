// This file checks components, families, fluents and windows of a mission file against the services and the
// world.
#pragma once

#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of owners that are no services, of timelines that nobody tells of, of states that a component can be
/// in and the mission does not know, of those beside them that it is never in, and of facts with more positions than
/// the state has arguments.
void check_components(const CheckedMission& mission, const CheckedExecutive& executive);

/// Complains of simulated components that wait for a window which the mission does not have, or whose commands need
/// components or states that there are not.
void check_simulation(const CheckedMission& mission);

/// Complains at `entry` if what it says is no service of the mission.
void require_owner(const mission::Entry& entry, const mission::ServiceList& services);

}  // namespace roci::rehearsal::check
