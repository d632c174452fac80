// This file reads traces from where runs leave them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "exec_svc/trace/recorded_trace.hpp"

namespace roci::exec::trace {

/// Reads a run folder, a journal.sqlite or a text that print() wrote, and changes none of them. With
/// `decisions` the goals, events, steps and calls come, too. Scenario and seed come from the summary.json
/// beside a journal, if there is one. Throws TraceError that names file and remedy, also for formats newer
/// than this code.
RecordedTrace read_run(const std::filesystem::path& run, bool decisions);

/// Returns the runs of a folder that is no run itself, by name: its texts NAME.trace and its run folders
/// NAME. There are none for anything else.
std::map<std::string, std::filesystem::path> runs_in(const std::filesystem::path& folder);

}  // namespace roci::exec::trace
