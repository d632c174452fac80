#include "core/temporal/schedule.hpp"

#include <cstdint>
#include <functional>
#include <queue>

namespace roci::temporal {
namespace {

struct Raise {  // t[to] >= t[from] + by
  TimePoint to;
  Duration by;
};

using Raises = std::vector<std::vector<Raise>>;  // by from

Raises raises_of(std::size_t point_count, const std::vector<TemporalConstraint>& constraints) {
  Raises raises(point_count);
  for (const TemporalConstraint& c : constraints) {
    if (bounded(c.lower)) raises[c.from_point].push_back({c.to_point, c.lower});
    if (bounded(c.upper)) raises[c.to_point].push_back({c.from_point, -c.upper});
  }
  return raises;
}

/// Returns the place of each point in an order in which the raises by 0 or more lead forward; points on
/// circles of them come last.
std::vector<std::uint32_t> topological_ranks(const Raises& raises) {
  std::vector<std::uint32_t> waiting(raises.size(), 0);
  for (const auto& from : raises)
    for (const Raise& raise : from)
      if (raise.by >= Duration{0}) ++waiting[raise.to];
  std::vector<TimePoint> order;
  for (TimePoint p = 0; p < raises.size(); ++p)
    if (waiting[p] == 0) order.push_back(p);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (const Raise& raise : raises[order[i]])
      if (raise.by >= Duration{0} && --waiting[raise.to] == 0) order.push_back(raise.to);
  std::vector<std::uint32_t> ranks(raises.size(), static_cast<std::uint32_t>(raises.size()));
  for (std::uint32_t i = 0; i < order.size(); ++i) ranks[order[i]] = i;
  return ranks;
}

}  // namespace

std::optional<std::vector<Duration>> earliest_schedule(std::size_t point_count,
                                                       const std::vector<TemporalConstraint>& constraints) {
  using Entry = std::pair<std::uint32_t, TimePoint>;
  using Sweep = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  const Raises raises = raises_of(point_count, constraints);
  const std::vector<std::uint32_t> ranks = topological_ranks(raises);
  std::vector<Duration> times(point_count, Duration{0});
  std::vector<char> queued(point_count, 1);
  Sweep sweep;
  Sweep next_sweep;
  for (TimePoint p = 0; p < point_count; ++p) sweep.emplace(ranks[p], p);
  for (std::size_t sweeps = 0; !sweep.empty(); ++sweeps) {
    if (sweeps > point_count) return std::nullopt;
    while (!sweep.empty()) {
      const auto [rank, point] = sweep.top();
      sweep.pop();
      queued[point] = 0;
      for (const Raise& raise : raises[point]) {
        if (times[point] + raise.by <= times[raise.to]) continue;
        if (raise.to == origin_point) return std::nullopt;
        times[raise.to] = times[point] + raise.by;
        if (queued[raise.to] != 0) continue;
        queued[raise.to] = 1;
        (ranks[raise.to] > rank ? sweep : next_sweep).emplace(ranks[raise.to], raise.to);
      }
    }
    std::swap(sweep, next_sweep);
  }
  return times;
}

}  // namespace roci::temporal
