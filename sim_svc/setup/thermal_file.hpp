// This file reads a robot's surroundings and thermal zones in the mission file.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/world/thermal.hpp"

namespace roci::sim::setup {

inline constexpr double kColdest = 1;         ///< K, of surroundings
inline constexpr double kHottest = 2000;      ///< K
inline constexpr double kLeastFactor = 0.01;  ///< of losses: without any, nothing ever cools

/// Reads `thermal` of a robot in mission.yaml: its surroundings and its zones by name (README.md). Throws
/// mission::FileError with place and remedy.
world::ThermalParameters read_thermal(const mission::Entry&);

/// Reads the temperature of surroundings, in K; throws mission::FileError.
double read_surroundings(const mission::Entry&);

}  // namespace roci::sim::setup
