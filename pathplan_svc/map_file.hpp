// This file reads what a mission file says of how the map of a robot is shared.
#pragma once
#include <cstdint>
#include <string>

#include "core/mission/entry.hpp"

namespace roci::pathplan {

/// Says when a robot's path planner tells the team what its map has beyond the loaded one.
enum class MapSharing : std::uint8_t {
  never,
  on_request,  ///< when its command `tell` is given
  at_once,     ///< moreover whenever its robot has found something
};

/// A mission says this of a robot's own map.
struct MapSettings {
  MapSharing sharing = MapSharing::never;
  std::string subsystem = "map";  ///< under which the path planner takes commands
};

/// Reads the section `map` of the mission file (README.md). Throws mission::FileError with place and remedy.
MapSettings read_map_settings(const mission::Entry& section);

}  // namespace roci::pathplan
