/// Gives the starts of a plan times of their own before it is executed: for a time-tagged plan (ECSS-E-ST-70-11C, E2;
/// Z23), and for latest starts (SanchoExpress, section 5.1; R129, R144). Both leave room for every command to last as
/// long as the plan allows.
#pragma once

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::reactor {

/// Each command starts at the earliest time at which everything before it may have lasted its longest, no sooner and no
/// later; where the plan has no room for the longest, at its earliest time. A start that the plan ties to the end of a
/// command goes with that end. What waits for longer than its window (push) is late instead.
void fix_starts(temporal::FlexiblePlan& plan);

/// Each start of which the plan bounds the latest time prefers the latest at which everything may still last its
/// longest. Nothing changes where the plan has no room for the longest.
void prefer_latest_starts(temporal::FlexiblePlan& plan);

}  // namespace roci::exec::reactor
