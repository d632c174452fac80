// Pair novelty tells how new a state is among those of its kind: whether one of its facts, or a pair of them,
// has not been seen before (Lipovetzky and Geffner 2012).
//
// Pairs are remembered in a bounded number of bits, by hash, so that some count as seen that have not been
// (Singh, Lipovetzky, Ramirez and Segovia-Aguas 2021).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roci::planner::temporal_pddl::search {

/// Remembers facts and pairs of facts by kind of state, in a fixed number of bytes.
class PairNovelty {
 public:
  static constexpr int kNothingNew = 3;

  /// Takes from 8 KiB for a few facts up to 8 MiB.
  explicit PairNovelty(std::size_t facts);

  /// Returns 1 if a fact of the state is new, 2 if only a pair of them is, or kNothingNew; from now on the
  /// state has been seen. Facts may be numbered in any way. `fresh` are those of them that a seen state of
  /// the same kind, from which it differs in nothing else, had not; or all, in the same order.
  int see(std::span<const std::uint32_t> facts, std::span<const std::uint32_t> fresh, std::uint64_t kind);
  std::size_t bytes() const { return bits_.capacity() * sizeof(std::uint64_t); }

 private:
  bool note(std::uint64_t place);

  std::vector<std::uint64_t> bits_;  // a power of two
};

}  // namespace roci::planner::temporal_pddl::search
