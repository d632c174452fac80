// A scenario may change what the mission says of the bodies' energy, heat and storage.
#pragma once
#include <set>
#include <string>

#include "core/mission/entry.hpp"
#include "sim_svc/world/robot.hpp"

namespace roci::sim::scenario {

/// Puts what a scenario's `world` says of bodies (use_factor, gauge, surroundings_k, waste_factor, loss_factor,
/// data_capacity_bytes) in place of what mission.yaml says, for all robots that have such a thing. A word that no robot
/// has a use for is an error. Adds the words to `known`. Throws mission::FileError with place and remedy.
void apply_body_conditions(const mission::Entry& world, std::vector<world::RobotSetup>& robots,
                           std::set<std::string, std::less<>>& known);

}  // namespace roci::sim::scenario
