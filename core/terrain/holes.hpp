// Holes of an elevation layer are filled from their neighbours here.
#pragma once
#include <cstddef>
#include <vector>

#include "core/terrain/site.hpp"

namespace roci::terrain {

/// Makes ground of unknown elevation, told by a value that is not finite, harmless to who computes with it: each
/// such cell becomes Occupancy::unknown and takes the elevation of a nearest known cell by moves to the four
/// neighbours. Returns the number of such cells. The layers fit the grid. Throws MapError if no cell is known.
std::size_t fill_holes(const Grid& grid, SiteLayers& layers);

}  // namespace roci::terrain
