#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/parameters.hpp"

namespace roci::sim {

/// Reads the section `simulation` of mission.yaml, all of whose keys are optional (parameters.hpp has the
/// defaults). Throws mission::FileError with place and remedy.
RobotParameters read_robot(const mission::Entry& simulation);

}  // namespace roci::sim
