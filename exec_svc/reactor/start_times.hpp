// This file gives the starts of a plan times of their own before it is executed: for a time-tagged plan
// (ECSS-E-ST-70-11C, E2; Z23), and for latest starts (SanchoExpress, section 5.1; R129, R144). Both leave room for
// every command to last as long as the plan allows.
#pragma once

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::reactor {

/// Fixes each command's start at the earliest time that lets everything before it last its longest, or at its earliest
/// time where the plan has no room for that. A start that the plan ties to the end of a command follows that end. A
/// start that is pushed beyond its window is late instead.
void fix_starts(temporal::FlexiblePlan& plan);

/// Lets each start whose latest time the plan bounds prefer the latest time at which everything may still last
/// its longest. Nothing changes where the plan has no room for the longest.
void prefer_latest_starts(temporal::FlexiblePlan& plan);

}  // namespace roci::exec::reactor
