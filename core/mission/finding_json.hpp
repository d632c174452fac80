// This file writes findings for programs: the array that every checker prints with --json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/mission/findings.hpp"

namespace roci::mission {

/// Returns an object for each finding, with file, line, column, severity ("error" or "warning"), what and remedy, by
/// file, line and column.
nlohmann::ordered_json to_json(const Findings& findings);

}  // namespace roci::mission
