// The scenarios of a mission: scenarios/NAME.yaml in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// What a service reads: a mission file is named itself or by its folder, whose mission.yaml it then is.
std::filesystem::path mission_file(const std::filesystem::path& folder_or_file);

// Throws FileError; for a name that no file has, with the names that there are.
Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name);

}  // namespace roci::mission
