// This file chooses which activities of a plan the screen shows when not all of them fit.
#pragma once

#include <cstddef>
#include <vector>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::watch {

/// Holds one row: an activity at its depth.
struct PlanRow {
  const v1::PlanActivity* activity = nullptr;
  std::size_t depth = 0;
  std::size_t folded = 0;  ///< activities below it that are not shown
};

/// Holds the rows that the screen shows, and counts what it leaves out.
struct PlanRows {
  std::vector<PlanRow> rows;
  std::size_t gone = 0;  ///< activities that have ended and are left out
  std::size_t more = 0;  ///< activities at the end that found no room
};

/// Returns at most `room` rows: each activity with its parts behind it, those of one parent by their starts; activities
/// without levels stand as in the plan. Where there is no room for all, what is over is folded into the activity that
/// it was part of, the oldest first; then what has not begun, the latest first; then single activities that are over
/// are left out; what runs stays the longest.
PlanRows plan_rows(const lib::MissionView& view, std::size_t room);

}  // namespace roci::console::cli::watch
