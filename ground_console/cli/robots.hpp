// This file shows what is known of each robot, side by side: where it is, what its subsystems do, what its map has,
// and what decisions are open and what is being repaired.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {

/// Holds what is known of one robot.
struct Robot {
  std::string name;
  std::optional<lib::Place> place{};
  std::optional<double> heading_rad{};
  std::optional<double> battery{};
  std::string doing{};  ///< the timeline of its name, where the plan has one for the robot as a whole
  /// What its other timelines of states say, by their names without the robot's.
  std::vector<std::pair<std::string, std::string>> states{};
  std::vector<const v1::KnownMap*> maps{};  ///< of its path planners
};

/// Its states; a family of three timelines or more, "way.w0.w1" and so on, is one: "way.*" is "3, newest w1.w2 open".
std::vector<std::pair<std::string, std::string>> states_by_family(const lib::MissionView& view,
                                                                  const Robot& robot);

/// The robots that services belong to, that are seen at a place, or that have a battery, by name.
std::vector<Robot> robots_of(const lib::MissionView& view);

/// Timelines of states that belong to no robot of these, e.g. those of the team.
std::vector<std::pair<std::string, std::string>> states_of_the_team(const lib::MissionView& view,
                                                                    const std::vector<Robot>& robots);

/// "x 6.2 y 15.0 m, heading 90°   battery 350 kJ", as far as it is known.
std::string where_text(const Robot& robot, const MissionWords& words);

/// "version 4: 2 obstacles (1 rock, 1 soil of scout), told version 3 at 00:02:00, has version 2 of scout.path".
std::string map_text(const v1::KnownMap& map);

/// The longest that the plan foresees for the activity that is repaired, as mission time; -1:
/// it knows no bound, or no such activity.
std::int64_t planned_end_us(const lib::MissionView& view, const lib::Repair& repair);

/// "scout.locomotion repairs p1.1-scout since 00:00:30, 45 % of the time until 00:01:10 used: drive: fault". Who joined
/// after the command was sent does not know until when there is time, and reads what was planned.
std::string repair_line(const lib::MissionView& view, const lib::Repair& repair);

/// The decisions that are open, by id.
std::vector<const v1::Decision*> open_decisions(const lib::MissionView& view);

/// Repairs, those under way first, then the newest first.
std::vector<const lib::Repair*> repairs_of(const lib::MissionView& view);

nlohmann::json robots_json(const lib::MissionView& view);
nlohmann::json repairs_json(const lib::MissionView& view);

/// Lines on robots, open decisions and repairs; without a robot and without the others, empty.
std::string robots_text(const lib::MissionView& view, const MissionWords& words = {});

}  // namespace roci::console::cli
