// LazyShortestPaths computes the shortest distances from points with fixed values where they are asked for.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/stn.hpp"

namespace roci::temporal {

/// Keeps value(head) = min over edges of value(tail) + weight, except where a value is fixed. Edges may be
/// reweighed, points fixed or cut off.
///
/// A change only forgets the values that may depend on it and are known; a value is computed again when
/// somebody asks, by a backward Dijkstra search on reduced costs that ends as soon as nothing farther away
/// can be smaller: every value lies at or above floor + potential. A search that grows too long computes all
/// values at once and takes them as the new potential, under which the searches after it are short again. So
/// an event costs the values that somebody has asked for and that it may move.
class LazyShortestPaths {
 public:
  struct Edge {
    TimePoint tail;
    TimePoint head;
    Duration weight;  ///< no_bound: absent
  };

  /// Takes edges with a potential for which potential[head] <= potential[tail] + weight on every edge. All
  /// values start unbounded.
  LazyShortestPaths(std::vector<Edge> edges, std::vector<Duration> potential);

  Duration value(TimePoint point) const;
  bool fixed(TimePoint point) const { return fixed_[point] != 0; }

  /// Gives the point this value from now on; edges into the point have no effect.
  void fix(TimePoint point, Duration value);
  /// Takes back the last operation, which must have been a fix().
  void undo_fix(TimePoint point);
  /// Gives the edge another weight, which may be smaller only where the tail is fixed.
  void reweigh(std::uint32_t edge, Duration weight);
  /// Takes all edges of the point away; it must not be fixed.
  void cut_off(TimePoint point);

  /// Names a point whose value was known, and which the last operation may have changed, with the value
  /// before.
  struct Change {
    TimePoint point;
    Duration before;
  };
  const std::vector<Change>& changes() const { return changes_; }

  /// Computes every value that is not known.
  void settle() const;

  /// Returns how many edges were looked at since the beginning: what the operations and questions so far have
  /// cost.
  std::uint64_t work() const { return work_; }

 private:
  using Entry = std::pair<Duration, TimePoint>;

  void forget(TimePoint point);
  void forget_heads(TimePoint point);
  void lower_floor(Duration reduced);
  bool search(TimePoint point) const;
  void compute_all() const;
  void rebase() const;

  std::vector<Edge> edges_;
  std::vector<std::uint32_t> out_begin_, out_, in_begin_, in_;  // edges by tail and by head
  std::vector<Duration> first_potential_;
  std::vector<char> fixed_;
  std::vector<Change> changes_;
  std::uint64_t rebases_at_fix_ = 0;

  // These hold what is known of the values; asking for one adds to it.
  mutable std::vector<Duration> potential_, value_;
  mutable std::vector<char> known_;
  mutable std::vector<char> passed_;          // not known, but known values were computed through it
  mutable std::vector<Duration> sure_above_;  // of a known value: it stands while the floor is not below this
  mutable std::vector<Entry> unsure_;         // heap of those, the highest first
  mutable Duration floor_ = no_bound;         // no value less its potential lies below this
  mutable std::vector<Duration> distance_;    // of a search
  mutable std::uint64_t rebases_ = 0;
  mutable std::uint64_t work_ = 0;
};

}  // namespace roci::temporal
