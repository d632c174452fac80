// Stn is a simple temporal network (Dechter, Meiri, Pearl 1991) with incremental consistency and windows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::temporal {

using TimePoint = std::uint32_t;
inline constexpr TimePoint origin_point = 0;

/// Holds the earliest and latest time relative to the origin; they are -no_bound / no_bound where nothing
/// bounds them.
struct Window {
  Duration lower = -no_bound;
  Duration upper = no_bound;
  friend bool operator==(const Window&, const Window&) = default;
};

/// Has time points 0..size()-1, of which point 0 is the origin, and is consistent at all times: a constraint
/// that would make it inconsistent is refused. A checkpoint is a copy (five flat arrays).
///
/// add() keeps a feasible potential by the incremental algorithm of Cotton and Maler (2006) and then lets the
/// distances from and to the origin sink by Dijkstra on reduced costs: work is local to what the constraint
/// tightens.
class Stn {
 public:
  explicit Stn(std::size_t point_count = 1);

  TimePoint add_point();
  std::size_t size() const { return potential_.size(); }

  /// Requires lower <= t[to] - t[from] <= upper. Returns false, with nothing changed, if that contradicts the
  /// network. Points must exist; lower = -no_bound and upper = no_bound leave that side open.
  [[nodiscard]] bool add(TimePoint from, TimePoint to, Duration lower, Duration upper = no_bound);

  /// Returns the minimal window: shortest paths to and from the origin.
  Window window(TimePoint point) const;

 private:
  struct Edge {  // t[to] - t[from] <= weight
    TimePoint from;
    TimePoint to;
    Duration weight;
    std::int32_t next_out;
    std::int32_t next_in;
  };

  bool add_edge(TimePoint from, TimePoint to, Duration weight);
  bool repair_potential(const Edge& added);
  void remove_last_edge();
  template <bool FromOrigin>
  void lower_distances(const Edge& added);

  std::vector<Edge> edges_;
  std::vector<std::int32_t> first_out_, first_in_;
  std::vector<Duration> potential_, from_origin_, to_origin_;
};

}  // namespace roci::temporal
