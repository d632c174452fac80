// What the services of a run say of samples that did not arrive over a radio, and whether it was made up for.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/scenario/heard_flight.hpp"

namespace roci::scenario {

/// By service: the lines of links/SERVICE.jsonl.
std::map<std::string, std::vector<nlohmann::json>> losses_of(const std::filesystem::path& run_folder);

/// A command that was lost is said again, or asked for, under its key; the last of a key to be lost belongs to a step
/// that has a word on it, which is that reason where the executive itself commanded.
/// Fails the test where neither is so.
void expect_asked_for(const HeardFlight& flight, const nlohmann::json& loss);

/// Each sample that a link counts as lost, superseded or sent again has a line of its own.
void expect_all_named(const std::filesystem::path& run_folder, const std::string& service,
                      const std::vector<nlohmann::json>& losses);

}  // namespace roci::scenario
