// This file has ways over the map, and the text in which commands carry them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/terrain/grid.hpp"

namespace roci::terrain {

/// Lists the points of a way, driven from the first to the last.
using Way = std::vector<Point>;

/// Returns "x,y;x,y;…" in metres of the map frame, each number as short as it reads back the same.
std::string to_text(const Way& way);

/// Holds the way that a text says, or why it says none: `fault` is empty or names the point, counted from 1.
struct WayInText {
  Way way;
  std::string fault;
};

/// Reads what to_text() writes: one to `most` points, all numbers finite. Nothing is kept of a text with more.
WayInText read_way(std::string_view text, std::size_t most);

/// Returns the way that ends so many metres before its end, measured along it; it keeps its first point in any case.
/// Less than nothing counts as nothing.
Way cut_short(Way way, double metres);

/// Returns the heading of the last leg that has a length (rad, from east towards north), or `otherwise` where none has.
double heading_at_end(const Way& way, double otherwise);

}  // namespace roci::terrain
