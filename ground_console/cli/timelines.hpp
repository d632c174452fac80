// This file shows the timelines of a mission over time: what the plan foresaw, what has come about, what is
// still to come.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/temporal/projection.hpp"
#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {

using Timelines = std::map<std::string, std::vector<temporal::ProjectedChange>>;

/// Of the running plan and of what is observed (the newest value of each, as executed by nobody); with names:
/// of these alone. What is projected starts at the newest observation of its timeline (R76), and
/// what was planned and executed is reckoned back from it; a number that nobody observed is its change since the plan
/// began. Throws WireError for a plan that no executive sends.
Timelines timelines_of(const lib::MissionView& view, const std::vector<std::string>& names);

nlohmann::json timelines_json(const lib::MissionView& view, const Timelines& timelines,
                              const MissionWords& words = {});
/// A block of lines for each timeline: time, value with its unit, kind, activity.
std::string timelines_text(const Timelines& timelines, const MissionWords& words = {});
/// A row for each timeline, once: its newest executed value and when it came about, the last one planned, and the last
/// one projected, with its unit. What was observed comes first.
std::string timelines_table(const Timelines& timelines, const MissionWords& words);

}  // namespace roci::console::cli
