// This file reads a polygon as mission and map files write it.
#pragma once
#include "core/mission/entry.hpp"
#include "core/terrain/polygon.hpp"

namespace roci::terrain {

/// Reads `{polygon: [[x, y], [x, y], [x, y], …]}`, metres of the map frame. Throws mission::FileError with place and
/// remedy for fewer than three corners or a corner that is not two numbers.
Polygon read_polygon(const mission::Entry& entry);

}  // namespace roci::terrain
