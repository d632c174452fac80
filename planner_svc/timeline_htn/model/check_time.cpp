#include <optional>

#include "core/temporal/stn.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/model/complaints.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"

namespace roci::planner::timeline_htn::model {

using temporal::Duration, temporal::no_bound;

namespace {

bool is_constant(const Expression& expression) {
  for (const ExpressionNode& node : expression)
    if (node.op == Operator::table) return false;
  return true;
}

// The number where it is the same for all objects, else `otherwise`; nothing where it is no duration.
std::optional<Duration> known(const Model& model, const Expression& expression, Duration otherwise) {
  if (expression.empty() || !is_constant(expression)) return otherwise;
  const auto number = evaluate(model, expression, {});
  return number ? duration_of(*number) : std::nullopt;
}

temporal::TimePoint point_of(const Point& point) {
  return (point.subgoal ? 2 * (*point.subgoal + 1) : 0) + (point.end ? 1 : 0);
}

std::string words(const Behaviour& behaviour, const Point& point) {
  return (point.subgoal ? behaviour.subgoals[*point.subgoal].name : "self") + (point.end ? ".end" : ".start");
}

}  // namespace

void check_time(Complaints& complaints) {
  const Model& model = complaints.model;
  for (std::size_t i = 0; i < model.behaviours.size(); ++i) {
    const Behaviour& behaviour = model.behaviours[i];
    complaints.about(Part::behaviour, i);
    temporal::Stn network(2 * (behaviour.subgoals.size() + 1));
    static_cast<void>(network.add(0, 1, Duration{0}));
    for (std::size_t s = 0; s < behaviour.subgoals.size(); ++s) {
      const auto start = static_cast<temporal::TimePoint>(2 * (s + 1));
      const Pattern& pattern = behaviour.subgoals[s].state;
      const State& state = model.components[pattern.component].states[pattern.state];
      const Duration shortest = known(model, state.shortest, Duration{0}).value_or(Duration{0});
      const Duration longest = known(model, state.longest, no_bound).value_or(no_bound);
      // Of these alone none contradicts another: a longest duration below the shortest is the state's fault.
      static_cast<void>(network.add(0, start, Duration{0}) && network.add(start + 1, 1, Duration{0}) &&
                        network.add(start, start + 1, shortest, longest));
    }
    for (const SubgoalConstraint& constraint : behaviour.constraints) {
      const auto lower = known(model, constraint.lower, -no_bound);
      const auto upper = known(model, constraint.upper, no_bound);
      if (!lower || !upper) {
        complaints.error("a bound of the time from " + words(behaviour, constraint.from) + " to " +
                             words(behaviour, constraint.to) + " is no number, or beyond " +
                             temporal::to_text(kLongestDuration) + " (31 years)",
                         "write a smaller one, or 'none'");
        continue;
      }
      if (network.add(point_of(constraint.from), point_of(constraint.to), *lower, *upper)) continue;
      complaints.error("it contradicts itself in time: " + words(behaviour, constraint.to) + " cannot be " +
                           (*lower == -no_bound ? "" : temporal::to_text(*lower) + " to ") +
                           temporal::to_text(*upper) + " after " + words(behaviour, constraint.from) +
                           " beside the constraints before it and the durations of the subgoals",
                       "take one of them out, or widen it");
    }
  }
}

}  // namespace roci::planner::timeline_htn::model
