// This file loads a checked network from a file of either form: everybody who wants to use one calls it.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/mission/findings.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::reading {

/// Reads a network file, YAML or binary, and checks the network. All faults are noted, each with file and line, or file
/// and byte, and with its remedy. Returns nothing where one is an error: a network is taken whole or not at all (R83).
std::optional<model::Network> load_network(const std::filesystem::path& file, mission::Findings& findings);

/// Does the same, and throws mission::FileError with the errors, one in each line.
model::Network load_network(const std::filesystem::path& file);

/// Takes a network that came as bytes in binary form, from the ground; `name` stands for the file.
std::optional<model::Network> take_network(std::string_view bytes, const std::filesystem::path& name,
                                           mission::Findings& findings);

}  // namespace roci::planner::utility_htn::reading
