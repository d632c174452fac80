#include "planner_svc/temporal_pddl/constraints/stn.hpp"

namespace roci::planner::temporal_pddl {

// Bellman and Ford; in plan order most edges go forward, so that the first pass settles most points.
bool Stn::raise(std::vector<Ticks>& times) const {
  for (std::size_t pass = 0; pass <= points_; ++pass) {
    bool changed = false;
    for (const Edge& edge : edges_) {
      if (times[edge.from] == kNoPath || times[edge.from] + edge.least <= times[edge.to]) continue;
      times[edge.to] = times[edge.from] + edge.least;
      changed = true;
    }
    if (!changed) return true;
  }
  return false;
}

std::optional<std::vector<Ticks>> Stn::longest_from(std::size_t source) const {
  std::vector<Ticks> times(points_, kNoPath);
  times[source] = 0;
  if (!raise(times)) return std::nullopt;
  return times;
}

std::optional<std::vector<Ticks>> Stn::longest_to(std::size_t target) const {
  Stn reversed(points_);
  for (auto edge = edges_.rbegin(); edge != edges_.rend(); ++edge)
    reversed.require(edge->to, edge->from, edge->least);
  return reversed.longest_from(target);
}

}  // namespace roci::planner::temporal_pddl
