// This is a simple temporal network that a search builds and takes back: earliest times and consistency.
#pragma once

#include <cstdint>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/stn.hpp"

namespace roci::planner::timeline_htn::search {

using temporal::Duration, temporal::TimePoint;

/// Has points at or after point 0, the origin, and not after the horizon. Beside temporal::Stn it can be taken back to
/// where it was, at the cost of what has changed since, and keeps no latest times.
///
/// A constraint is an edge: the time of its head is not below that of its tail plus a weight. add() lets the earliest
/// times rise along the edges; where that would raise the edge's own tail there is a positive cycle (Cotton and Maler
/// 2006, for the earliest times as potential).
class Network {
 public:
  explicit Network(Duration horizon) : horizon_(horizon), earliest_{Duration{0}}, first_{-1} {}

  TimePoint add_point();
  /// Requires lower <= t[to] - t[from] <= upper. Returns false where no schedule does;
  /// then the network must be taken back.
  [[nodiscard]] bool add(TimePoint from, TimePoint to, Duration lower, Duration upper = temporal::no_bound);
  Duration earliest(TimePoint point) const { return earliest_[point]; }
  std::size_t size() const { return earliest_.size(); }

  struct Mark {
    std::size_t points, edges, raised;
  };
  Mark mark() const { return {earliest_.size(), edges_.size(), raised_.size()}; }
  void take_back(const Mark& mark);

  /// Holds a constraint as it was added.
  struct Edge {  // t[to] >= t[from] + weight
    TimePoint from, to;
    Duration weight;
    std::int32_t next;
  };
  const std::vector<Edge>& edges() const { return edges_; }
  std::size_t bytes() const {
    return edges_.capacity() * sizeof(Edge) + earliest_.capacity() * 12 + raised_.capacity() * sizeof(Raised);
  }

 private:
  struct Raised {
    TimePoint point;
    Duration before;
  };
  bool add_edge(TimePoint from, TimePoint to, Duration weight);

  Duration horizon_;
  std::vector<Edge> edges_;
  std::vector<Duration> earliest_;
  std::vector<std::int32_t> first_;  // edge from each point
  std::vector<Raised> raised_;
  std::vector<TimePoint> queue_;
};

}  // namespace roci::planner::timeline_htn::search
