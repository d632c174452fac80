// This is what roci prints: text for people, JSON for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {

nlohmann::json to_json(const v1::GoalStatus& status);
nlohmann::json to_json(const v1::Event& event);
nlohmann::json status_json(const lib::MissionView& view);
nlohmann::json plan_json(const lib::MissionView& view);

/// One line of JSON, whatever bytes its texts hold.
std::string json_text(const nlohmann::json& json);

std::string padded(std::string text, std::size_t width);
/// Control characters of others never reach the terminal: "?" stands for each.
std::string printable(std::string text);

/// A goal's reason has a first line in the words of the mission; what follows, "details: …", are those of the planner.
std::string reason_of(const v1::GoalStatus& status);
std::string details_of(const v1::GoalStatus& status);  ///< empty if there are none

std::string goal_line(const v1::GoalStatus& status);
/// Returns whether an answer refuses what was sent: a new goal, or a change of one, which stays as it was.
bool is_refused(const v1::GoalStatus& answer);
std::string event_line(const v1::Event& event);
std::string status_text(const lib::MissionView& view, const MissionWords& words = {});

}  // namespace roci::console::cli
