// What every flight of the Europa lander keeps, and what success is in each of its scenarios
// (MEXEC, section V.B, R124).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tests/scenario/europa_course.hpp"

namespace roci::scenario {

/// Returns when the lander hears what the ground says in that scenario, through a fixed uplink; none: it says nothing.
std::optional<double> hears_the_ground_at(const std::string& scenario);

/// Holds a flight of that name against what all of them keep and what success is in its scenario. All keep zones within
/// their ranges, a battery that is never below empty, the limits of energy for each downlink and each sol, and the
/// subway map; their cycles come out again from their records, and every schedule of downlinks is right for the independent
/// checker; the ground is heard while the radio receives; decisional data go with the next downlink; all of every
/// sample that was analyzed is on Earth. A test fails where one is broken.
void check_rules(const std::string& scenario, const Course& course, const std::filesystem::path& run_folder);

}  // namespace roci::scenario
