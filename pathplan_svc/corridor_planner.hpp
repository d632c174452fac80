// The corridor planner is the second stage of path planning: it finds a fast drive near a guide that the grid
// search found.
#pragma once

#include <cstdint>
#include <optional>

#include "pathplan_svc/segment.hpp"

namespace roci::pathplan {

/// Says the work and shape of a search in numbers of samples, never in seconds.
struct CorridorSettings {
  double half_width = 6.0;         ///< m, how far samples lie beside the guide
  double samples_per_metre = 1.5;  ///< of the guide
  int min_samples = 60;
  int max_samples = 300;
};

/// Returns a fast drive from the first to the last point of `guide`, a free polyline, by OMPL's FMT* (Janson
/// et al., "Fast marching tree", Int. J. Robotics Research 34(7), 2015) over samples around the guide and the
/// guide itself; the cost is driving time without turns. The result is deterministic: samples come from
/// `seed` alone, and none of OMPL's own random numbers (whose seed is process-wide) takes part. Returns
/// nothing if FMT* finds no way, which a guide does not exclude.
std::optional<Polyline> plan_in_corridor(const Costmap& map, const DriveModel& drive, const Polyline& guide,
                                         const CorridorSettings& settings, std::uint64_t seed);

}  // namespace roci::pathplan
