// Two happenings that interfere must not stand closer than epsilon (Fox and Long 2003, definition 12).
#pragma once

#include <optional>
#include <string>

#include "planner_svc/temporal_pddl/validate/state.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Holds what a start, an end, an instantaneous action or a timed fact read and changed as it was executed.
struct Footprint {
  Reads reads;
  Changes changes;
};

/// Returns the printed fact or fluent over which two happenings interfere, or nothing: one changes what the
/// other reads, one deletes what the other adds, or both set a fluent and not both by increase or decrease.
std::optional<std::string> interference(const Footprint& a, const Footprint& b);

/// Returns a fluent that one happening on its own sets more than once and not only by increase and decrease,
/// or nothing.
std::optional<std::string> conflict(const Changes& changes);

}  // namespace roci::planner::temporal_pddl::validate
