// This file writes findings as the lines that programs that check files print.
#pragma once

#include <string>

#include "core/mission/findings.hpp"

namespace roci::mission {

/// Returns "error" or "warning".
const char* to_string(Severity severity);

/// Returns "file:line:column: error: what" as a line, and what to do about it, if that is known, indented in another.
std::string report(const Finding& finding);

/// Returns the lines of all, by file, line and column.
std::string report(const Findings& findings);

}  // namespace roci::mission
