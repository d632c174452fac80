// The mission check finds everything that can be found wrong with a mission before it is flown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/mission/findings.hpp"
#include "rehearsal/check/dry_plan.hpp"

namespace roci::rehearsal::check {

/// Holds everything that was found wrong with a mission, and what was checked.
struct CheckReport {
  mission::Findings findings;
  std::vector<std::string> scenarios;  ///< that were read
  DryPlans plans;
};

/// Reads mission.yaml, the files that it names and every scenario (or `scenario` alone), compares what they name with
/// each other, with the services, the simulated world and the domain, asks the owners of functions, and plans a goal of
/// each kind. Nothing is planned while something else is wrong. Throws mission::FileError for a scenario that is not
/// there, and services::transport::TransportError as AskedOwners does.
CheckReport check_mission(const std::filesystem::path& folder, const std::string& scenario = "");

}  // namespace roci::rehearsal::check
