#include "core/temporal/execution_windows.hpp"

#include <stdexcept>

namespace roci::temporal {
namespace {

std::vector<BoundField::Edge> edges_of(const std::vector<TemporalConstraint>& constraints) {
  std::vector<BoundField::Edge> edges;
  edges.reserve(2 * constraints.size());
  for (const TemporalConstraint& c : constraints) {
    edges.push_back({c.from_point, c.to_point, c.upper});
    edges.push_back({c.to_point, c.from_point, -c.lower});
  }
  return edges;
}

std::vector<BoundField::Edge> mirrored(std::vector<BoundField::Edge> edges) {
  for (BoundField::Edge& edge : edges) std::swap(edge.tail, edge.head);
  return edges;
}

Stn network_of(std::size_t point_count, const std::vector<TemporalConstraint>& constraints) {
  Stn network(point_count);
  for (const TemporalConstraint& c : constraints)
    if (!network.add(c.from_point, c.to_point, c.lower, c.upper))
      throw std::invalid_argument("execution windows of an inconsistent network");
  return network;
}

/// The earliest schedule satisfies every constraint: it is a feasible potential.
std::vector<Duration> earliest_schedule(const Stn& network, int sign) {
  std::vector<Duration> potential(network.size());
  for (TimePoint p = 0; p < network.size(); ++p) potential[p] = sign * network.window(p).lower;
  return potential;
}

}  // namespace

ExecutionWindows::ExecutionWindows(std::size_t point_count,
                                   const std::vector<TemporalConstraint>& constraints, Time origin)
    : ExecutionWindows(edges_of(constraints), network_of(point_count, constraints), origin) {}

ExecutionWindows::ExecutionWindows(std::vector<BoundField::Edge> edges, const Stn& network, Time origin)
    : latest_(edges, earliest_schedule(network, 1)),
      earliest_(mirrored(std::move(edges)), earliest_schedule(network, -1)) {
  happen(origin_point, origin);
}

Window ExecutionWindows::window(TimePoint point) const {
  return {-earliest_.value(point), latest_.value(point)};
}

void ExecutionWindows::happen(TimePoint point, Time at) {
  latest_.fix(point, at);
  earliest_.fix(point, -at);
}

void ExecutionWindows::undo_happen(TimePoint point) {
  latest_.undo_fix(point);
  earliest_.undo_fix(point);
}

void ExecutionWindows::set_bounds(std::size_t constraint, Duration lower, Duration upper) {
  const auto edge = static_cast<std::uint32_t>(2 * constraint);
  latest_.reweigh(edge, upper);
  earliest_.reweigh(edge + 1, -lower);
}

void ExecutionWindows::drop(TimePoint point) {
  latest_.cut_off(point);
  earliest_.cut_off(point);
}

}  // namespace roci::temporal
