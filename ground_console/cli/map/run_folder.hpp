// This file reads what a run left in its folder, for a picture of it (docs/formats.md).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/mission/service_list.hpp"
#include "ground_console/cli/map/mission_map.hpp"

namespace roci::console::cli::map {

/// Returns what `roci-trace print --decisions` says of the run (without decisions of a printed trace that has none), of
/// several executives in the order of time; or nothing if it fails, which that program has explained on standard error:
/// it reads journals, the ground tool does not.
std::optional<std::string> trace_of(const std::filesystem::path& run);

/// The folder of the mission that was flown, which stands in the launcher's command line.
/// Throws std::invalid_argument with the remedy.
std::filesystem::path mission_of(const std::filesystem::path& run);

/// "scenario nominal, seed 1, flown 00:12:00, achieved", or the folder's name where there is no summary.
std::string words_of_summary(const std::filesystem::path& run);

/// Who has a map of its own: the robot of each path planner, by the planner's name; nobody where there are not several.
std::map<std::string, std::string> map_owners(const mission::ServiceList& list);

/// Adds the obstacles that path planners knew when the run ended, NAME.hazards: to the map of all,
/// and to that of the planner's robot.
void add_hazards(const std::filesystem::path& run, const std::map<std::string, std::string>& owners,
                 MissionMap& map);

}  // namespace roci::console::cli::map
