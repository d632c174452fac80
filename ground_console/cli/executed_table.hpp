// This file prints a plan that has ended, as it was executed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "roci_idl/executed.h"

namespace roci::console::cli {

/// A row for each activity, in the order of the real starts, what never started last. Below a level of the hierarchy
/// stand its parts, indented.
std::string executed_table(const v1::ExecutedPlan& plan);

/// The same; times in seconds of mission time, absent where something never started or ended.
nlohmann::json executed_json(const v1::ExecutedPlan& plan);

/// One activity of it, in a line and as JSON.
std::string executed_line(const v1::ExecutedActivity& one);
nlohmann::json executed_json(const v1::ExecutedActivity& one);

}  // namespace roci::console::cli
