#pragma once
#include <filesystem>

#include "sim_svc/scenario.hpp"
#include "sim_svc/world.hpp"

namespace roci::sim {

/// All that a run of the simulator needs.
struct RunSetup {
  WorldSetup world;
  Scenario scenario;
};

/// Reads mission.yaml of the folder (`site`, `arm`, `windows`, `simulation`), the files that it names, and
/// the scenario. Throws mission::FileError with place and remedy.
RunSetup load_run(const std::filesystem::path& mission_folder, const std::string& scenario);

}  // namespace roci::sim
