#include "core/temporal/stn.hpp"

#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace roci::temporal {
namespace {

constexpr std::int32_t no_edge = -1;

/// Gives the lowest key first; the point breaks ties, so that runs are repeatable.
using Queue = std::priority_queue<std::pair<Duration, TimePoint>, std::vector<std::pair<Duration, TimePoint>>,
                                  std::greater<>>;

}  // namespace

Stn::Stn(std::size_t point_count)
    : first_out_(point_count, no_edge),
      first_in_(point_count, no_edge),
      potential_(point_count, Duration{0}),
      from_origin_(point_count, no_bound),
      to_origin_(point_count, no_bound) {
  if (point_count > 0) from_origin_[origin_point] = to_origin_[origin_point] = Duration{0};
}

TimePoint Stn::add_point() {
  const auto point = static_cast<TimePoint>(size());
  first_out_.push_back(no_edge);
  first_in_.push_back(no_edge);
  potential_.push_back(Duration{0});
  from_origin_.push_back(point == origin_point ? Duration{0} : no_bound);
  to_origin_.push_back(point == origin_point ? Duration{0} : no_bound);
  return point;
}

bool Stn::add(TimePoint from, TimePoint to, Duration lower, Duration upper) {
  if (lower > upper) return false;
  if (from == to) return lower <= Duration{0} && upper >= Duration{0};
  std::size_t added = 0;
  const auto try_edge = [&](TimePoint tail, TimePoint head, Duration weight) {
    if (!bounded(weight)) return true;
    ++added;
    return add_edge(tail, head, weight);
  };
  if (!try_edge(from, to, upper) || !try_edge(to, from, -lower)) {
    for (; added > 0; --added) remove_last_edge();
    return false;
  }
  for (std::size_t i = edges_.size() - added; i < edges_.size(); ++i) {
    lower_distances<true>(edges_[i]);
    lower_distances<false>(edges_[i]);
  }
  return true;
}

Window Stn::window(TimePoint point) const { return {-to_origin_[point], from_origin_[point]}; }

bool Stn::add_edge(TimePoint from, TimePoint to, Duration weight) {
  const auto index = static_cast<std::int32_t>(edges_.size());
  edges_.push_back({from, to, weight, first_out_[from], first_in_[to]});
  first_out_[from] = first_in_[to] = index;
  return repair_potential(edges_.back());
}

void Stn::remove_last_edge() {
  const Edge& last = edges_.back();
  first_out_[last.from] = last.next_out;
  first_in_[last.to] = last.next_in;
  edges_.pop_back();
}

/// Makes the potential feasible for the added edge too. Returns false, with the potential unchanged, if a
/// negative cycle passes through it. It stays feasible if that edge is taken out again.
bool Stn::repair_potential(const Edge& added) {
  const Duration excess = potential_[added.from] + added.weight - potential_[added.to];
  if (excess >= Duration{0}) return true;
  std::unordered_map<TimePoint, Duration> lowered;  // new potentials, final
  std::unordered_map<TimePoint, Duration> wanted;   // by how much a point must sink, best known
  Queue queue;
  wanted[added.to] = excess;
  queue.push({excess, added.to});
  while (!queue.empty()) {
    const auto [sink, point] = queue.top();
    queue.pop();
    if (lowered.contains(point)) continue;
    if (point == added.from) return false;
    const Duration potential = potential_[point] + sink;
    lowered[point] = potential;
    for (std::int32_t e = first_out_[point]; e != no_edge; e = edges_[static_cast<std::size_t>(e)].next_out) {
      const Edge& edge = edges_[static_cast<std::size_t>(e)];
      if (lowered.contains(edge.to)) continue;
      const Duration next = potential + edge.weight - potential_[edge.to];
      Duration& best = wanted[edge.to];  // 0 where there was none
      if (next >= best) continue;
      best = next;
      queue.push({next, edge.to});
    }
  }
  for (const auto& [point, potential] : lowered) potential_[point] = potential;
  return true;
}

template <bool FromOrigin>
void Stn::lower_distances(const Edge& added) {
  std::vector<Duration>& distance = FromOrigin ? from_origin_ : to_origin_;
  const auto key = [&](TimePoint point) {
    return FromOrigin ? distance[point] - potential_[point] : distance[point] + potential_[point];
  };
  Queue queue;
  const auto relax = [&](const Edge& edge) {
    const TimePoint tail = FromOrigin ? edge.from : edge.to;
    const TimePoint head = FromOrigin ? edge.to : edge.from;
    if (!bounded(distance[tail]) || distance[tail] + edge.weight >= distance[head]) return;
    distance[head] = distance[tail] + edge.weight;
    queue.push({key(head), head});
  };
  relax(added);
  while (!queue.empty()) {
    const auto [best, point] = queue.top();
    queue.pop();
    if (best != key(point)) continue;
    std::int32_t e = FromOrigin ? first_out_[point] : first_in_[point];
    while (e != no_edge) {
      const Edge& edge = edges_[static_cast<std::size_t>(e)];
      relax(edge);
      e = FromOrigin ? edge.next_out : edge.next_in;
    }
  }
}

}  // namespace roci::temporal
