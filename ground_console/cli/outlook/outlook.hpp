// These views show what planners expect of their plans, as the ground sees it: the downlink schedule, ranked utility,
// energy, the subway map (R110–R115, R127). Each comes as text, JSON and one picture, and is a function of a sample
// alone.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "roci_idl/outlook.h"

namespace roci::console::cli::outlook {

/// Pictures show so many rows of a list at most, and say how many more there are.
inline constexpr std::size_t kMostRows = 200;

/// Which data go with which downlink, in their order, and what is left out or late, and why.
std::string downlinks_text(const v1::DownlinkSchedule& schedule);
nlohmann::json downlinks_json(const v1::DownlinkSchedule& schedule);
std::string downlinks_svg(const v1::DownlinkSchedule& schedule);

/// What each chain of the plan and all data are worth by rank, predicted and executed, and what the ranks mean.
std::string utility_text(const v1::MissionOutlook& outlook);
nlohmann::json utility_json(const v1::MissionOutlook& outlook);
std::string utility_svg(const v1::MissionOutlook& outlook);

/// A whole mission over time: chains that were done, that run and that are planned, a row for all requests whose names
/// differ in the numbers at their end (figure 8).
std::string chains_text(const v1::MissionOutlook& outlook);
nlohmann::json chains_json(const v1::MissionOutlook& outlook);
std::string chains_svg(const v1::MissionOutlook& outlook);

/// The budget at the end of each planned task, as predicted and in the worst and the best case.
std::string energy_text(const v1::MissionOutlook& outlook);
nlohmann::json energy_json(const v1::MissionOutlook& outlook);
std::string energy_svg(const v1::MissionOutlook& outlook);

/// Sites by their chance, their targets with outcomes, and which is next.
std::string subway_text(const v1::MissionOutlook& outlook);
nlohmann::json subway_json(const v1::MissionOutlook& outlook);
std::string subway_svg(const v1::MissionOutlook& outlook);

}  // namespace roci::console::cli::outlook
