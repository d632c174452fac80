// Made images of ground for the tests of science_svc.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "science_svc/detector.hpp"

namespace roci::science {

inline constexpr int kWidth = 96;
inline constexpr int kHeight = 64;

/// Grey ground with noise of its own for each seed, a light sky above; a square of so many pixels a side and of this
/// grey stands with its middle at (48, `row`), if it has a side.
inline terrain::GreyImage made_ground(std::uint64_t seed, int side = 0, int grey = 240, int row = 38) {
  std::mt19937_64 random(seed);
  terrain::GreyImage out{kWidth, kHeight, 255, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = std::abs(x - 48) * 2 < side && std::abs(y - row) * 2 < side;
      const int base = inside ? grey : y < 6 ? 200 : 110;
      out.pixels.push_back(static_cast<std::uint16_t>(base + static_cast<int>(random() % 15) - 7));
    }
  }
  return out;
}

inline Photo photo(const std::string& id, terrain::Point at, const terrain::GreyImage& pixels,
                   double heading = 0) {
  return {id, {at, heading}, pixels};
}

}  // namespace roci::science
