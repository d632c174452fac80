// Shortcuts make paths with fewer corners.
#pragma once
#include "pathplan_svc/segment.hpp"

namespace roci::pathplan {

/// Finds the fastest way along a subset of the corners of `path` (first and last kept), turns included:
/// exact, by dynamic programming over pairs of corners. Only straight pieces that are free and at most
/// `max_piece` metres long are used; neighbouring corners of `path` count as connected. It costs about n² / 2
/// segments and n³ / 6 turns for n corners.
Polyline shortcut(const Costmap& map, const DriveModel& drive, const Polyline& path, double max_piece);

/// Drops corners until at most about `corners` remain, keeping every piece free: a dropped corner is one
/// whose neighbours see each other.
Polyline thin(const Costmap& map, const Polyline& path, std::size_t corners);

}  // namespace roci::pathplan
