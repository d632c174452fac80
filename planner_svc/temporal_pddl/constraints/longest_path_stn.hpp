// LongestPathStn is a simple temporal network (Dechter, Meiri and Pearl 1991) over time points 0 … n − 1 in
// its longest-path form, solved as a whole.
//
// It is not temporal::Stn, which keeps a growing network consistent edge by edge: a search asks about a
// network once, and a batch of Bellman-Ford passes in plan order settles it in mostly one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::planner::temporal_pddl::constraints {

/// Stands for the length of a path that does not exist; it is below every bound that a network can have.
inline constexpr temporal::Duration kNoPath = temporal::Duration::min();

/// Holds the points and constraints of one network, which it solves as often as it is asked.
class LongestPathStn {
 public:
  explicit LongestPathStn(std::size_t points = 0) : points_(points) {}

  void reset(std::size_t points) {
    points_ = points;
    edges_.clear();
  }
  /// Adds points behind the existing ones.
  void extend(std::size_t points) { points_ += points; }
  /// Requires t(to) − t(from) ≥ least. A bound from above is one with the points exchanged and the sign
  /// turned.
  void require(std::size_t from, std::size_t to, temporal::Duration least) {
    edges_.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), least});
  }
  std::size_t points() const { return points_; }

  /// Raises `times` to the least values that obey all constraints and are no lower than given; points at
  /// kNoPath are free until an edge reaches them. Returns false if there are none: a cycle has positive
  /// length.
  bool raise(std::vector<temporal::Duration>& times) const;

  /// Returns the longest paths from `source` (itself 0), with kNoPath where there is none; or nothing if the
  /// network is inconsistent.
  std::optional<std::vector<temporal::Duration>> longest_from(std::size_t source) const;

 private:
  struct Edge {
    std::uint32_t from, to;
    temporal::Duration least;
  };

  std::size_t points_;
  std::vector<Edge> edges_;
};

}  // namespace roci::planner::temporal_pddl::constraints
