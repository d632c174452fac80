// The scenarios of a mission are the files scenarios/NAME.yaml in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/entry.hpp"
#include "core/mission/mission_file.hpp"

namespace roci::mission {

/// Reads a scenario of a mission. Throws FileError; for a name that no file has, it lists those that there are.
Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name);

}  // namespace roci::mission
