#include "planner_svc/timeline_htn/search/network.hpp"

namespace roci::planner::timeline_htn::search {

using temporal::bounded;

TimePoint Network::add_point() {
  earliest_.push_back(Duration{0});
  first_.push_back(-1);
  return static_cast<TimePoint>(earliest_.size() - 1);
}

bool Network::add(TimePoint from, TimePoint to, Duration lower, Duration upper) {
  if (lower > upper) return false;
  if (bounded(lower) && !add_edge(from, to, lower)) return false;
  return !bounded(upper) || add_edge(to, from, -upper);
}

bool Network::add_edge(TimePoint from, TimePoint to, Duration weight) {
  if (from == to) return weight <= Duration{0};
  if (from == temporal::origin_point && weight <= Duration{0}) return true;  // holds for every point
  edges_.push_back({from, to, weight, first_[from]});
  first_[from] = static_cast<std::int32_t>(edges_.size() - 1);
  queue_.clear();
  const auto raise = [&](TimePoint point, Duration time) {
    if (time <= earliest_[point]) return true;
    if (point == from || point == temporal::origin_point || time > horizon_) return false;
    raised_.push_back({point, earliest_[point]});
    earliest_[point] = time;
    queue_.push_back(point);
    return true;
  };
  if (!raise(to, earliest_[from] + weight)) return false;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const TimePoint point = queue_[i];
    for (std::int32_t e = first_[point]; e >= 0; e = edges_[static_cast<std::size_t>(e)].next) {
      const Edge& edge = edges_[static_cast<std::size_t>(e)];
      if (!raise(edge.to, earliest_[point] + edge.weight)) return false;
    }
  }
  return true;
}

void Network::take_back(const Mark& mark) {
  while (raised_.size() > mark.raised) {
    earliest_[raised_.back().point] = raised_.back().before;
    raised_.pop_back();
  }
  while (edges_.size() > mark.edges) {
    first_[edges_.back().from] = edges_.back().next;
    edges_.pop_back();
  }
  earliest_.resize(mark.points);
  first_.resize(mark.points);
}

}  // namespace roci::planner::timeline_htn::search
