// Network distances say how far any two points of a network lie apart at least and at most.
#pragma once

#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/stn.hpp"

namespace roci::temporal {

/// Answers questions about pairs of points of one network by shortest paths: Dijkstra's algorithm with the earliest
/// schedule as potential (Johnson 1977), begun anew for each question and ended as soon as it is answered.
class NetworkDistances {
 public:
  /// Points of constraints must lie below `point_count`. As everywhere no point lies before time 0.
  NetworkDistances(std::size_t point_count, const std::vector<TemporalConstraint>& constraints);

  /// Returns whether some schedule satisfies the constraints. Without one the questions below must not be asked.
  bool consistent() const { return consistent_; }

  /// Returns how far `to` lies after `from` at least and at most, over all schedules.
  Window between(TimePoint from, TimePoint to) const;

  /// Returns whether lower <= t[to] - t[from] <= upper holds in every schedule.
  bool implies(TimePoint from, TimePoint to, Duration lower, Duration upper) const;

  /// Returns whether both have the same time in every schedule.
  bool same_time(TimePoint a, TimePoint b) const { return implies(a, b, Duration{0}, Duration{0}); }

 private:
  struct Edge {  // t[to] - t[from] <= weight
    TimePoint to;
    Duration weight;
  };

  /// Returns the greatest t[to] - t[from], or no_bound where it is above `enough`.
  Duration greatest(TimePoint from, TimePoint to, Duration enough) const;

  bool consistent_ = false;
  std::vector<std::vector<Edge>> edges_;  // by from
  std::vector<Duration> potential_;
};

}  // namespace roci::temporal
