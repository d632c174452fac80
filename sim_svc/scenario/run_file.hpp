// A run of the simulator is read from the files of a mission.
#pragma once

#include <filesystem>
#include <string>

#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/scenario.hpp"
#include "sim_svc/setup/roster_file.hpp"
#include "sim_svc/world/world.hpp"

namespace roci::sim::scenario {

/// Holds all that a run of the simulator needs.
struct RunSetup {
  world::WorldSetup world;
  Scenario scenario;
  setup::Roster roster;  ///< of the robots in `world`, as the mission file lists them
};

/// Reads mission.yaml of the folder (`windows`, `simulation`; `site` and `arm` if a component needs them),
/// the files that it names, and the scenario. Throws mission::FileError with place and remedy; with `findings` it
/// notes all faults there, and what is returned lacks the parts that could not be read.
RunSetup load_run(const std::filesystem::path& mission_folder, const std::string& scenario,
                  const setup::Registry& types = components::standard_types(),
                  mission::Findings* findings = nullptr);

}  // namespace roci::sim::scenario
