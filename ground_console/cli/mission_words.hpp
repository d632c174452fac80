// Mission words are what a mission file says to people: its goal kinds with help and example, and the units
// of its timelines.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace roci::console::cli {

/// Describes a kind of goals to people, with an example.
struct GoalKindWords {
  std::string name;
  std::string help;
  std::vector<std::pair<std::string, std::string>> arguments;  ///< name and kind: number, text, goal
  std::map<std::string, std::string> example;  ///< a value for each argument, as far as the mission says
  bool has_window = false;                     ///< false: a goal with --opens or --closes is refused
};

/// Holds what a mission file says to people.
struct MissionWords {
  std::string name;
  std::vector<GoalKindWords> goal_kinds;
  std::map<std::string, std::string> units;  ///< by timeline, "rover.battery" → "J"; a name may end in *

  /// Returns the unit of a timeline, or an empty text if it has none.
  std::string unit_of(const std::string& timeline) const;
};

/// "755 kJ", "1.25 MJ": three digits and a prefix for J, W, Wh, B and b, "12.5 m" and "3" for all else.
std::string amount_text(double amount, const std::string& unit);

/// Reads mission.yaml of that folder. Throws mission::FileError.
MissionWords read_mission_words(const std::filesystem::path& folder_or_file);

/// The command that asks for a goal of the kind, with the example's values or a placeholder for each argument.
std::string example_of(const GoalKindWords& kind);

std::string goal_kinds_text(const MissionWords& words);
nlohmann::json goal_kinds_json(const MissionWords& words);

}  // namespace roci::console::cli
