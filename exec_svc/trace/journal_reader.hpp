// This file reads the lines of a trace in a journal's SQLite file, without the executive's own code: it
// reads every version of the journal that there ever was (docs/formats.md).
#pragma once

#include <filesystem>
#include <vector>

#include "exec_svc/trace/recorded_trace.hpp"

namespace roci::exec::trace {

/// Opens the file for reading alone. Throws TraceError.
std::vector<Line> read_journal(const std::filesystem::path& file, bool decisions);

}  // namespace roci::exec::trace
