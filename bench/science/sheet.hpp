// A contact sheet of the images that the detector was measured on.
#pragma once
#include <string>

#include "bench/science/trials.hpp"

namespace roci::bench::science {

/// Draws images in rows as one binary PPM file, each pixel as a square of `zoom`: what the detector finds at this
/// threshold is framed, green at an odd target and red elsewhere; targets that it does not find are framed blue.
std::string sheet(const std::vector<World>&, double threshold, double reach, int columns, int rows, int zoom);

}  // namespace roci::bench::science
