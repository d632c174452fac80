// This file reads the outcome of a run as its executives wrote it (docs/formats.md, "Summary").
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/mission/service_list.hpp"

namespace roci::services::process {

/// Names the program whose services count goals.
inline constexpr char kExecutive[] = "exec_svc";

/// Returns what the executives of the list left in the run folder: the summary of the only one as it is; for
/// several, one that adds up their goals, calls and replans, with each one's own below `executives`. Its result
/// is achieved if every executive with goals achieved its hard ones, and failed if one of them failed or left
/// no summary. Returns an empty object if none left any. Throws std::runtime_error for a summary of a newer
/// format.
nlohmann::json read_summary(const std::filesystem::path& run_folder, const mission::ServiceList& list);

}  // namespace roci::services::process
