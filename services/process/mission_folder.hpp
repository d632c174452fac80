// This file finds where a mission named on a command line stands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace roci::services::process {

/// Returns the folder of a mission: `mission` is a folder with mission.yaml, or the name of a mission in one
/// of mission_libraries(). Throws std::invalid_argument that lists the missions there are.
std::filesystem::path mission_folder(const std::string& mission);

/// Returns the folders of missions: missions/ of the working folder, of the installation, and of the source
/// tree of a build.
std::vector<std::filesystem::path> mission_libraries();

}  // namespace roci::services::process
