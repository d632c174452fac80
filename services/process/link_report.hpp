// A link report is what each service of a run tells, in the run folder, of the links that it heard over.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/link/channel.hpp"
#include "services/node.hpp"

namespace roci::services::process {

/// Writes links/<service>.json, if a link of the scenario carried anything to the node and there is a run
/// folder, and links/<service>.jsonl with a line for each sample that did not arrive at an attempt: what it was, and
/// what is done about it (docs/links.md). Call it when the node's loop has ended.
void write_link_report(const Node&, const std::filesystem::path& run_folder);

/// Returns what becomes of a sample that did not arrive at an attempt, in the words of the table in docs/links.md.
const char* effect_of(const link::LostSample&);

/// Returns the sum of all reports, by name of the link. Other files are ignored.
std::map<std::string, link::Counts> read_link_reports(const std::filesystem::path& run_folder);

/// Returns the counts as the member `links` of a summary (docs/formats.md).
nlohmann::json as_json(const std::map<std::string, link::Counts>&);

}  // namespace roci::services::process
