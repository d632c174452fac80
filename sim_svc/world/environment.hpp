// The environment surrounds the robots of a simulated world and is the same for all: ground, rocks, windows
// of time.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/terrain/site.hpp"
#include "sim_svc/world/surface.hpp"
#include "sim_svc/world/values.hpp"
#include "sim_svc/world/windows.hpp"

namespace roci::sim::world {

/// Describes a boulder that no map shows, in metres.
struct Rock {
  double x = 0;
  double y = 0;
  double radius = 0;
};

/// Holds the true ground.
struct Ground {
  std::shared_ptr<const terrain::Site> site;  ///< empty in a world without ground
  std::vector<Rock> hidden_rocks;
  Surface surface{};
};

/// Holds what all robots of a world share.
struct Environment {
  Ground ground;
  std::vector<Window> windows;
  std::map<std::size_t, std::string> known_rocks;  ///< index into Ground::hidden_rocks → id, once one was met
  std::map<std::string, std::string> samples;  ///< sample → place where it lies; empty: somebody holds it
  std::vector<Effect> effects{};               ///< since they were taken last
  std::map<std::string, Pose> poses{};         ///< of the robots that stand on the map, as of the last event
};

}  // namespace roci::sim::world
