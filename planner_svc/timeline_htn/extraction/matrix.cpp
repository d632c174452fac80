#include "planner_svc/timeline_htn/extraction/matrix.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/temporal/execution_windows.hpp"

namespace roci::planner::timeline_htn::extraction {

using temporal::Duration, temporal::FlexiblePlan, temporal::TemporalConstraint, temporal::TimePoint;

namespace {

// The points that constraints [0, 0] hold together have one leader.
std::vector<TimePoint> leaders(const FlexiblePlan& plan) {
  std::vector<TimePoint> leader(plan.point_count);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](TimePoint point) {
    while (leader[point] != point) point = leader[point] = leader[leader[point]];
    return point;
  };
  for (const TemporalConstraint& constraint : plan.constraints) {
    if (constraint.lower != Duration{0} || constraint.upper != Duration{0}) continue;
    const TimePoint a = find(constraint.from_point), b = find(constraint.to_point);
    leader[std::max(a, b)] = std::min(a, b);
  }
  for (TimePoint point = 0; point < leader.size(); ++point) leader[point] = find(point);
  return leader;
}

}  // namespace

Matrix matrix_of(const FlexiblePlan& plan) {
  Matrix out;
  const std::vector<TimePoint> leader = leaders(plan);
  temporal::ExecutionWindows windows(plan.point_count, temporal::all_constraints(plan), Duration{0});
  windows.settle();
  std::map<TimePoint, Transition> transitions;
  for (const temporal::Token& token : plan.tokens) {
    if (std::ranges::find(out.timelines, token.timeline) == out.timelines.end())
      out.timelines.push_back(token.timeline);
    Transition& transition = transitions[leader[token.start_point]];
    if (std::ranges::find(transition.points, token.start_point) == transition.points.end())
      transition.points.push_back(token.start_point);
    transition.window = windows.window(leader[token.start_point]);
  }
  std::vector<TimePoint> order;
  for (const auto& [point, transition] : transitions) order.push_back(point);
  std::ranges::stable_sort(order, [&](TimePoint a, TimePoint b) {
    const temporal::Window &x = transitions[a].window, &y = transitions[b].window;
    return std::pair(x.lower, x.upper) < std::pair(y.lower, y.upper);
  });
  std::map<TimePoint, std::size_t> column;
  for (const TimePoint point : order) {
    column[point] = out.transitions.size();
    out.transitions.push_back(transitions[point]);
  }
  out.values.assign(out.timelines.size(), std::vector<temporal::Value>(order.size()));
  out.changes.assign(out.timelines.size(), std::vector<bool>(order.size(), false));
  for (const temporal::Token& token : plan.tokens) {
    const auto row =
        static_cast<std::size_t>(std::ranges::find(out.timelines, token.timeline) - out.timelines.begin());
    const std::size_t from = column[leader[token.start_point]];
    const auto end = column.find(leader[token.end_point]);
    const std::size_t to = end == column.end() ? order.size() : end->second;
    for (std::size_t j = from; j < to; ++j) out.values[row][j] = token.held;
    out.changes[row][from] = true;
  }
  return out;
}

}  // namespace roci::planner::timeline_htn::extraction
