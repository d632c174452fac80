// Execution windows bound a plan's time points while it is executed.
#pragma once

#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/lazy_shortest_paths.hpp"
#include "core/temporal/stn.hpp"

namespace roci::temporal {

/// Gives [earliest, latest] of every point that has not happened, from those that have and the constraints
/// between them. An event replaces every constraint into its point by its real time, so an event that
/// contradicts the network makes no inconsistency: it only moves the windows of others (a latest time may
/// then lie in the past). Durations are contingent in just this sense. Times are mission times. A window is
/// computed when it is asked for; what an event costs is as of LazyShortestPaths.
class ExecutionWindows {
 public:
  /// The constraints must be consistent and bound every point from below by the origin, as all_constraints()
  /// of a plan that passed check() does. The origin has happened, at `origin`.
  ExecutionWindows(std::size_t point_count, const std::vector<TemporalConstraint>& constraints, Time origin);

  Window window(TimePoint point) const;
  bool happened(TimePoint point) const { return latest_.fixed(point); }

  void happen(TimePoint point, Time at);
  /// Takes back the happen() just made.
  void undo_happen(TimePoint point);
  /// Sets new bounds for a constraint whose from point has happened and whose to point has not.
  void set_bounds(std::size_t constraint, Duration lower, Duration upper);
  /// Takes the point out, as it will not happen: its constraints are gone.
  void drop(TimePoint point);

  /// Computes the windows of all points at once, for whoever asks for many.
  void settle() const;

  /// These return the windows that were known and that the last operation may have moved; `before` of
  /// earliest changes is negated.
  const std::vector<LazyShortestPaths::Change>& latest_changes() const { return latest_.changes(); }
  const std::vector<LazyShortestPaths::Change>& earliest_changes() const { return earliest_.changes(); }

  /// Counts as LazyShortestPaths::work() does.
  std::uint64_t work() const { return latest_.work() + earliest_.work(); }

 private:
  ExecutionWindows(std::vector<LazyShortestPaths::Edge> edges, std::vector<Duration> potential, Time origin);

  // Each constraint has two edges: 2c is the upper bound, 2c + 1 the lower. The field of earliest times is
  // the mirror: reversed edges, negated values.
  LazyShortestPaths latest_;
  LazyShortestPaths earliest_;
};

}  // namespace roci::temporal
