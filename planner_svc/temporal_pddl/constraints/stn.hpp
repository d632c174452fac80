// Simple Temporal Networks (Dechter, Meiri and Pearl 1991) over time points 0 … n − 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace roci::planner::temporal_pddl {

// Microseconds.
using Ticks = std::int64_t;
inline constexpr Ticks kNoPath = std::numeric_limits<Ticks>::min();
inline constexpr Ticks kNever = std::numeric_limits<Ticks>::max();

class Stn {
 public:
  explicit Stn(std::size_t points = 0) : points_(points) {}

  void reset(std::size_t points) {
    points_ = points;
    edges_.clear();
  }
  // Adds points behind those that there are.
  void extend(std::size_t points) { points_ += points; }
  // t(to) − t(from) ≥ least. A bound from above is one with the points exchanged and the sign turned.
  void require(std::size_t from, std::size_t to, Ticks least) {
    edges_.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), least});
  }
  std::size_t points() const { return points_; }

  // Raises `times` to the least values that obey all constraints and are no lower than given; points at
  // kNoPath are free until an edge reaches them. False if there are none: a cycle of positive length.
  bool raise(std::vector<Ticks>& times) const;

  // Longest paths from `source` (itself 0), or to `target`; kNoPath where there is none. None: inconsistent.
  std::optional<std::vector<Ticks>> longest_from(std::size_t source) const;
  std::optional<std::vector<Ticks>> longest_to(std::size_t target) const;

 private:
  struct Edge {
    std::uint32_t from, to;
    Ticks least;
  };

  std::size_t points_;
  std::vector<Edge> edges_;
};

}  // namespace roci::planner::temporal_pddl
