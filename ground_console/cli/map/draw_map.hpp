// This file draws the map of a mission.
#pragma once
#include "ground_console/cli/map/mission_map.hpp"
#include "ground_console/cli/map/picture.hpp"

namespace roci::console::cli::map {

/// Draws the map with north up: the ground with shade (light from the north-west, as maps have it) and rocks, unknown
/// ground hatched, keep-out zones, hazards, planned and driven ways, places with their names, coordinates along the
/// sides, a scale bar, and a legend of what is on the map. `side`: pixels of its longer side.
Picture draw_map(const MissionMap& map, int side = 1000);

}  // namespace roci::console::cli::map
