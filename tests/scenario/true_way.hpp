// Whether a way exists at all on the true map, soil included: an oracle that shares no code with pathplan_svc.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/terramechanics.hpp"
#include "sim_svc/world/environment.hpp"

namespace roci::scenario {

/// What a rover can bear, in metres and degrees.
struct TrueLimits {
  double radius_m = 0.8;
  double max_slope_deg = 15;
  double rock_clearance_m = 0.1;
  sim::components::WheeledVehicle vehicle;
};

/// A way over the centres of cells that keeps the radius from rocks and from the edge of the map, stays below the
/// slope, and enters no soil that does not bear the vehicle on the steepest line there.
struct TrueWay {
  double length_m = 0;
  std::vector<terrain::Point> points;
};

/// The primary of missions/faster as its path planner knows it, where it starts and where its target lies.
inline constexpr TrueLimits kYardPrimary{0.8, 15, 0.1, {2354, 6, 0.1, 0.3}};
inline constexpr terrain::Point kYardStart{5, 15}, kYardTarget{20, 15};

/// The ground of a scenario of a mission folder as it is, soil scattered by the seed.
sim::world::Ground true_ground(const std::string& mission, const std::string& scenario, std::uint64_t seed);

/// Returns a shortest such way (Dijkstra over the eight neighbours, diagonally only between free cells), or nothing if
/// there is none. The soil has been scattered. Where an end is not free itself there is no way.
std::optional<TrueWay> true_way(const sim::world::Ground&, const TrueLimits&, terrain::Point from,
                                terrain::Point to);

/// Whether soil at the point does not bear the vehicle.
bool no_go_at(const sim::world::Ground&, const sim::components::WheeledVehicle&, terrain::Point);

}  // namespace roci::scenario
