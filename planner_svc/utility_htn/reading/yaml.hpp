// Task networks as YAML (R67, R83), the form that people write: docs/network-format.md is its schema.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/mission/findings.hpp"
#include "planner_svc/utility_htn/model/check.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::reading {

/// Numbers the version of the form that is written, and the newest that is read (docs/formats.md).
inline constexpr int kYamlFormat = 1;

/// Tells where the parts of a network stand in its files: "file:line:column".
using Places = std::map<std::pair<model::Part, std::uint32_t>, std::string>;

/// Holds a network that was read, and where its parts stand.
struct Read {
  std::optional<model::Network> network;  ///< none: some finding is an error
  Places places{};
};

/// Reads a file and those that it includes, without model::check().
/// Every fault is noted with its place; nothing is thrown.
Read read_yaml(const std::filesystem::path& file, mission::Findings& findings);
/// Reads a text that came otherwise; `name` stands for its file.
Read parse_yaml(const std::string& text, const std::filesystem::path& name, mission::Findings& findings);

/// Writes a network that was checked, in full: nothing repeated, nothing included, equal networks equally. What is read
/// of it is equal to the network, if the constraints of each task stand in the order of their phases.
std::string to_yaml(const model::Network& network);

}  // namespace roci::planner::utility_htn::reading
