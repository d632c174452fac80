// The scenarios of a mission are the files scenarios/NAME.yaml in its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/mission/mission_file.hpp"

namespace roci::mission {

/// Returns the names of the scenarios of a mission, in alphabetical order.
std::vector<std::string> scenario_names(const std::filesystem::path& folder_or_file);

/// Reads a scenario of a mission. Throws FileError; for a name that no file has, it lists those that there are.
/// `findings` as in Entry::load().
Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name,
                    Findings* findings = nullptr);

}  // namespace roci::mission
