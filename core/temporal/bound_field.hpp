// Shortest distances from points with fixed values, kept under changes in both directions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/stn.hpp"

namespace roci::temporal {

/// value(head) = min over edges of value(tail) + weight, except where a value is fixed. Edges may be
/// reweighed, points fixed or cut off; each change costs work in the points whose value changes and their
/// neighbours: the part of the shortest-path tree below a risen edge is recomputed by Dijkstra on reduced
/// costs (in the manner of Ramalingam and Reps 1996), a sunk value is passed on by the same.
class BoundField {
 public:
  struct Edge {
    TimePoint tail;
    TimePoint head;
    Duration weight;  ///< no_bound: absent
  };

  /// potential: potential[head] <= potential[tail] + weight for every edge. All values start unbounded.
  BoundField(std::vector<Edge> edges, std::vector<Duration> potential);

  Duration value(TimePoint point) const { return value_[point]; }
  bool fixed(TimePoint point) const { return fixed_[point] != 0; }

  /// From now on the value is given; edges into the point have no effect.
  void fix(TimePoint point, Duration value);
  /// A smaller weight only where one end of the edge is fixed.
  void reweigh(std::uint32_t edge, Duration weight);
  /// Takes all edges of the point away; it must not be fixed.
  void cut_off(TimePoint point);

  /// Points whose value the last operation changed, with the value before; each once.
  struct Change {
    TimePoint point;
    Duration before;
  };
  const std::vector<Change>& changes() const { return changes_; }

  /// Takes back the last operation, which must have been a fix().
  void undo_fix(TimePoint point);

 private:
  static constexpr std::int32_t none = -1;

  struct Saved {
    TimePoint point;
    Duration value;
    std::int32_t parent;
  };

  void begin();
  void save(TimePoint point);
  void set(TimePoint point, Duration value, std::int32_t parent);
  void collect_below(TimePoint root);
  void recompute_affected();
  void relax(std::uint32_t edge);
  void settle();
  void finish();

  std::vector<Edge> edges_;
  std::vector<std::uint32_t> out_begin_, out_, in_begin_, in_;  // edges by tail and by head
  std::vector<Duration> potential_, value_;
  std::vector<std::int32_t> parent_;  // edge that gives the value
  std::vector<char> fixed_, saved_mark_, affected_mark_;
  std::vector<TimePoint> affected_;
  std::vector<std::pair<Duration, TimePoint>> heap_;
  std::vector<Saved> saved_;
  std::vector<Change> changes_;
};

}  // namespace roci::temporal
