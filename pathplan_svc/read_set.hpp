// A read set is the part of the map on which an answer rests, so that a change elsewhere leaves the answer
// valid.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/terrain/grid.hpp"

namespace roci::pathplan {

/// Holds which part of a map a computation has looked at, in square tiles of at least 8 x 8 cells, so that its size is
/// the same for every map. What has looked at no tile of a changed cell would come out the same again.
class ReadSet {
 public:
  ReadSet() = default;
  explicit ReadSet(const terrain::Grid& grid) {
    while ((std::max(grid.columns, grid.rows) - 1) >> shift_ >= kTiles) ++shift_;
  }

  /// Adds a cell of the map.
  void add(terrain::Cell c) {
    const std::size_t tile = tile_of(c);
    words_[tile / 64] |= std::uint64_t{1} << (tile % 64);
  }
  /// Tells whether the tile of a cell of the map was looked at.
  bool has(terrain::Cell c) const {
    const std::size_t tile = tile_of(c);
    return (words_[tile / 64] >> (tile % 64) & 1U) != 0;
  }
  /// Tells whether the two, of one map, have a tile in common.
  bool meets(const ReadSet& other) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if ((words_[i] & other.words_[i]) != 0) return true;
    }
    return false;
  }

 private:
  static constexpr int kTiles = 32;  // a side

  std::size_t tile_of(terrain::Cell c) const {
    return static_cast<std::size_t>((c.row >> shift_) * kTiles + (c.column >> shift_));
  }

  int shift_ = 3;
  std::array<std::uint64_t, kTiles * kTiles / 64> words_{};
};

}  // namespace roci::pathplan
