// This file finds the starts at which a task would break bounds on one timeline (R75); it searches only those blocks in
// which it could.
#pragma once

#include <span>
#include <vector>

#include "core/temporal/timelines/effect.hpp"
#include "core/temporal/timelines/line.hpp"
#include "core/temporal/timelines/start_search.hpp"

namespace roci::temporal::timelines {

/// Appends to `bad` the starts within `window` at which the task would break bounds of the timeline's range or of other
/// tasks where they hold without it, or one of its own constraints (`own`: those on this timeline).
void find_bad_starts(const Line& line, const Effect& effect, std::span<const Constraint* const> own,
                     Stretch window, std::vector<Stretch>& bad, Scratch& scratch);

}  // namespace roci::temporal::timelines
