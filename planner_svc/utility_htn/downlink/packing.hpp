// The packing problem of the Downlink Manager in integers (MEXEC, appendix A, equations 6–14): items of a size and a
// value by rank go into bins of a capacity, each into at most one that it may use.
// Bins of one sol moreover share the sol's energy.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace roci::planner::utility_htn::downlink {

/// Describes an item to be packed: a product.
struct Item {
  std::uint64_t bytes = 0;           ///< S_i
  std::uint32_t first = 0;           ///< U_ij = 1 for all bins before this one
  std::vector<std::int64_t> values;  ///< V_i by rank, the highest first (Z17)
};

/// Describes a bin: a downlink window.
struct Bin {
  std::uint64_t capacity = 0;  ///< C_j
  std::uint64_t used = 0;      ///< taken already by what has no choice
  double joules_per_byte = 0;
  std::optional<std::size_t> sol{};  ///< index of an energy limit
};

/// Holds a packing problem.
struct Packing {
  std::vector<Item> items;
  std::vector<Bin> bins;
  std::vector<double> sol_joules;  ///< limits
  std::size_t ranks = 0;           ///< each item has so many values
};

/// Returns what an item is worth at a rank; at the one behind all of utility each counts as 1.
inline std::int64_t value_of(const Packing& packing, std::size_t item, std::size_t rank) {
  return rank < packing.ranks ? packing.items[item].values[rank] : 1;
}
/// Returns its bytes, one at least, so that something can be divided by them.
double size_of(const Item& item);
/// Returns whether the one has more utility for each byte than the other, by rank.
bool denser(const Packing& packing, std::size_t one, std::size_t other);
/// Returns the joules that each sol has beside what its bins have used.
std::vector<double> joules_left(const Packing& packing);

/// Gives the bin of each item (X_ij).
using Placement = std::vector<std::optional<std::uint32_t>>;

/// Says what a placement is worth; the greater one is better.
struct Worth {
  std::vector<std::int64_t> sums;  ///< by rank
  std::int64_t sent = 0;           ///< number of items
  std::int64_t earliness = 0;      ///< minus the sum of the bins' numbers
  friend auto operator<=>(const Worth&, const Worth&) = default;
};
Worth worth(const Packing& packing, const Placement& placement);

/// Keeps account of what still fits. What it answers does not depend on the order in which items came.
class Room {
 public:
  explicit Room(const std::vector<Bin>& bins, const std::vector<double>& sol_joules);
  explicit Room(const Packing& packing) : Room(packing.bins, packing.sol_joules) {}
  bool fits(std::uint64_t bytes, std::size_t bin) const;
  void take(std::uint64_t bytes, std::size_t bin) { used_[bin] += bytes; }
  void give_back(std::uint64_t bytes, std::size_t bin) { used_[bin] -= bytes; }
  std::uint64_t used(std::size_t bin) const { return used_[bin]; }

 private:
  const std::vector<Bin>& bins_;
  const std::vector<double>& sol_joules_;
  std::vector<std::vector<std::size_t>> by_sol_;
  std::vector<std::uint64_t> used_;
};

/// Returns the bins that each item may use and fits into alone, in order.
std::vector<std::vector<std::uint32_t>> choices(const Packing& packing);

/// Returns whether no bin, no energy limit and no creation time is broken.
bool holds(const Packing& packing, const Placement& placement);

}  // namespace roci::planner::utility_htn::downlink
