// A trace stands as text, one line each; this file writes and reads it. The first line names the format and
// its version; docs/formats.md publishes it.
#pragma once

#include <iosfwd>
#include <string>

#include "exec_svc/trace/recorded_trace.hpp"

namespace roci::exec::trace {

/// Numbers the newest version of the text that this code reads, and the one that it writes.
inline constexpr int kTextFormat = 1;

/// Writes the first line and then each line as `MICROSECONDS TEXT`. A line feed in a text is written as `\n`,
/// a backslash as `\\`.
void print(std::ostream& out, const RecordedTrace& trace);

/// Reads what print() wrote: parse(print(t)) == t. Throws TraceError with `name`, line and remedy, also for a
/// version that is newer than kTextFormat.
RecordedTrace parse(std::istream& in, const std::string& name);

}  // namespace roci::exec::trace
