#include "core/temporal/timeline_form.hpp"

#include <map>

#include "core/temporal/network_distances.hpp"

namespace roci::temporal {
namespace {

std::string in_words(const Window& window) {
  return "[" + (bounded(window.lower) ? to_text(window.lower) : std::string("unbounded")) + ", " +
         to_text(window.upper) + "]";
}

std::string in_words(const Token& token) { return to_text(token.held); }

/// Has the tokens of each timeline in the order of the list.
using Timelines = std::map<std::string, std::vector<const Token*>>;

// Says which value cannot last as its bounds say, or which constraint is the first that contradicts those before it.
std::string contradiction(const FlexiblePlan& plan, const std::vector<TemporalConstraint>& constraints) {
  Stn network(plan.point_count);
  for (const TemporalConstraint& c : constraints) {
    if (network.add(c.from_point, c.to_point, c.lower, c.upper)) continue;
    for (const Token& token : plan.tokens) {
      const bool forward = token.start_point == c.from_point && token.end_point == c.to_point;
      const bool backward = token.start_point == c.to_point && token.end_point == c.from_point;
      if (forward || backward)
        return "timeline " + token.timeline + ": the bounds of how long it holds " + in_words(token) +
               " contradict each other or the rest of the plan";
    }
    return "the timelines have no schedule: point " + std::to_string(c.to_point) + " cannot lie " +
           in_words(Window{c.lower, c.upper}) + " after point " + std::to_string(c.from_point);
  }
  return "the timelines have no schedule";
}

std::string joint_fault(const Token& before, const Token& after, const Window& apart) {
  const std::string values = in_words(before) + " and " + in_words(after);
  if (apart.lower > Duration{0}) return "there is a gap of " + in_words(apart) + " between " + values;
  if (apart.upper < Duration{0})
    return in_words(after) + " begins before " + in_words(before) +
           " ends: they overlap, or stand out of order";
  return values + " are not joined: from the end of one to the start of the other it may be " +
         in_words(apart);
}

}  // namespace

std::vector<std::string> timeline_faults(const FlexiblePlan& plan, Duration horizon) {
  const std::vector<TemporalConstraint> constraints = all_constraints(plan);
  const NetworkDistances network(plan.point_count, constraints);
  if (!network.consistent()) return {contradiction(plan, constraints)};
  Timelines timelines;
  for (const Token& token : plan.tokens) timelines[token.timeline].push_back(&token);
  std::vector<std::string> faults;
  for (const auto& [name, tokens] : timelines) {
    const auto fault = [&faults, &name = name](const std::string& what) {
      faults.push_back("timeline " + name + ": " + what);
    };
    const Token& first = *tokens.front();
    if (!network.same_time(origin_point, first.start_point))
      fault("its first value, " + in_words(first) + ", begins in " +
            in_words(network.between(origin_point, first.start_point)) + " and not at the origin");
    for (std::size_t i = 1; i < tokens.size(); ++i) {
      const TimePoint end = tokens[i - 1]->end_point, start = tokens[i]->start_point;
      if (!network.same_time(end, start))
        fault(joint_fault(*tokens[i - 1], *tokens[i], network.between(end, start)));
    }
    const Token& last = *tokens.back();
    if (!network.implies(origin_point, last.end_point, horizon, horizon))
      fault("its last value, " + in_words(last) + ", ends in " +
            in_words(network.between(origin_point, last.end_point)) + " and not at the horizon, " +
            to_text(horizon));
  }
  return faults;
}

}  // namespace roci::temporal
