// The scenarios of a mission: scenarios/NAME.yaml in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// What a service reads: a mission file is named itself or by its folder, whose mission.yaml it then is.
std::filesystem::path mission_file(const std::filesystem::path& folder_or_file);

/// Reads a scenario of a mission. Throws FileError; for a name that no file has, it lists those that there are.
Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name);

}  // namespace roci::mission
