// An oracle for timelines: it goes through a small world microsecond by microsecond and knows nothing of knots,
// aggregates or intervals.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines::oracle {

/// Is the last microsecond of an oracle's world, which begins at 0.
inline constexpr std::int64_t kEnd = 40;

struct Placed {
  Footprint footprint;
  std::int64_t start = 0;
  std::int64_t end = 0;
};

/// Is one broken bound at one side of one microsecond.
using Breach = std::tuple<Index, std::optional<TaskId>, std::size_t, std::int64_t, Side>;

/// Holds what was placed and observed, as plain lists.
struct World {
  std::vector<Definition> definitions;
  std::map<TaskId, Placed> tasks;
  std::map<std::pair<Index, std::int64_t>, double> observations;

  /// Returns by microsecond and side the values of a timeline, in millionths.
  std::vector<std::array<std::int64_t, 3>> values(Index timeline) const;
  std::set<Breach> breaches() const;
  /// Returns the starts within the window at which the task breaks nothing that holds without it, by trying each.
  std::vector<Interval> valid_starts(const Footprint& footprint, Interval window) const;
  std::vector<Conflict> conflicts(Time from, Time to) const;
};

/// Draws worlds in which numbers are small, so that ties and touching bounds are frequent.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(int percent) { return between(1, 100) <= percent; }

  std::vector<Definition> definitions();
  Footprint footprint(const std::vector<Definition>& definitions, int longest);
  double observed(const Definition& definition);

 private:
  Definition definition(Kind kind);
  Impact impact(const std::vector<Definition>& definitions, Index timeline);
  Constraint constraint(const std::vector<Definition>& definitions, Index timeline);
  std::mt19937_64 random_;
};

}  // namespace roci::temporal::timelines::oracle
