#include "core/temporal/network_distances.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>

#include "core/temporal/schedule.hpp"

namespace roci::temporal {

NetworkDistances::NetworkDistances(std::size_t point_count,
                                   const std::vector<TemporalConstraint>& constraints)
    : edges_(point_count) {
  for (const TemporalConstraint& c : constraints) {
    if (bounded(c.upper)) edges_[c.from_point].push_back({c.to_point, c.upper});
    if (bounded(c.lower)) edges_[c.to_point].push_back({c.from_point, -c.lower});
  }
  auto schedule = earliest_schedule(point_count, constraints);
  consistent_ = schedule.has_value();
  if (schedule) potential_ = std::move(*schedule);
}

// On reduced weights, weight + potential[from] - potential[to] >= 0, the nearest open point is final.
Duration NetworkDistances::greatest(TimePoint from, TimePoint to, Duration enough) const {
  if (from == to) return Duration{0};
  const Duration shift = potential_[from] - potential_[to];
  const Duration limit = bounded(enough) ? plus(enough, shift) : no_bound;
  using Entry = std::pair<Duration, TimePoint>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::unordered_map<TimePoint, Duration> best{{from, Duration{0}}};
  open.emplace(Duration{0}, from);
  while (!open.empty()) {
    const auto [distance, point] = open.top();
    open.pop();
    if (distance > limit) return no_bound;
    if (point == to) return distance - shift;
    if (distance > best[point]) continue;
    for (const Edge& edge : edges_[point]) {
      const Duration reached = distance + edge.weight + potential_[point] - potential_[edge.to];
      const auto [found, first] = best.try_emplace(edge.to, reached);
      if (!first && found->second <= reached) continue;
      found->second = reached;
      open.emplace(reached, edge.to);
    }
  }
  return no_bound;
}

Window NetworkDistances::between(TimePoint from, TimePoint to) const {
  return {-greatest(to, from, no_bound), greatest(from, to, no_bound)};
}

bool NetworkDistances::implies(TimePoint from, TimePoint to, Duration lower, Duration upper) const {
  return (!bounded(upper) || greatest(from, to, upper) <= upper) &&
         (!bounded(lower) || greatest(to, from, -lower) <= -lower);
}

}  // namespace roci::temporal
