#include "core/temporal/execution_windows.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include "core/temporal/schedule.hpp"

namespace roci::temporal {
namespace {

std::vector<LazyShortestPaths::Edge> edges_of(const std::vector<TemporalConstraint>& constraints) {
  std::vector<LazyShortestPaths::Edge> edges;
  edges.reserve(2 * constraints.size());
  for (const TemporalConstraint& c : constraints) {
    edges.push_back({c.from_point, c.to_point, c.upper});
    edges.push_back({c.to_point, c.from_point, -c.lower});
  }
  return edges;
}

std::vector<LazyShortestPaths::Edge> mirrored(std::vector<LazyShortestPaths::Edge> edges) {
  for (LazyShortestPaths::Edge& edge : edges) std::swap(edge.tail, edge.head);
  return edges;
}

/// Returns a schedule that satisfies every constraint: it is a feasible potential.
std::vector<Duration> potential_of(std::size_t point_count,
                                   const std::vector<TemporalConstraint>& constraints) {
  std::optional<std::vector<Duration>> schedule = earliest_schedule(point_count, constraints);
  if (!schedule) throw std::invalid_argument("execution windows of an inconsistent network");
  return *std::move(schedule);
}

std::vector<Duration> negated(std::vector<Duration> times) {
  for (Duration& time : times) time = -time;
  return times;
}

}  // namespace

ExecutionWindows::ExecutionWindows(std::size_t point_count,
                                   const std::vector<TemporalConstraint>& constraints, Time origin)
    : ExecutionWindows(edges_of(constraints), potential_of(point_count, constraints), origin) {}

ExecutionWindows::ExecutionWindows(std::vector<LazyShortestPaths::Edge> edges,
                                   std::vector<Duration> potential, Time origin)
    : latest_(edges, potential), earliest_(mirrored(std::move(edges)), negated(std::move(potential))) {
  happen(origin_point, origin);
  settle();
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

void ExecutionWindows::settle() const {
  latest_.settle();
  earliest_.settle();
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
