// When two happenings must not stand closer than epsilon (Fox and Long 2003, definition 12).
#pragma once

#include <optional>
#include <string>

#include "planner_svc/temporal_pddl/validate/state.hpp"

namespace roci::planner::temporal_pddl::validate {

/// A start, an end, an instantaneous action or a timed fact, as it was executed.
struct Footprint {
  Reads reads;
  Changes changes;
};

/// The printed fact or fluent over which they interfere: one changes what the other reads, one deletes what
/// the other adds, or both set a fluent and not both by increase or decrease.
std::optional<std::string> interference(const Footprint& a, const Footprint& b);

/// A fluent that one happening on its own sets more than once, not only by increase and decrease.
std::optional<std::string> conflict(const Changes& changes);

}  // namespace roci::planner::temporal_pddl::validate
