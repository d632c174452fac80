// The report holds what validation found.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/plan_text.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Names what a violation breaks.
enum class ViolationKind {
  unknown_action,   ///< the domain has no action of this name
  wrong_arguments,  ///< number, unknown object, or type
  time,             ///< start before 0; duration missing, out of place or against the constraints
  condition,        ///< one of a start, an end or an instantaneous action does not hold
  invariant,        ///< an over-all condition, somewhere strictly inside the action
  /// Means two happenings less than epsilon apart of which one changes what the other needs or changes.
  interference,
  conflicting_effects,  ///< one happening sets a fluent in two ways at once
  undefined_value,      ///< an effect computes with a fluent that has no value, or divides by zero
  goal,                 ///< a goal that does not hold at the end
};

/// Returns the kind in words, as in "undefined value".
std::string_view to_string(ViolationKind kind);

/// Tells one thing that a plan breaks, where and when.
struct Violation {
  ViolationKind kind = ViolationKind::goal;
  std::optional<std::size_t> step;  ///< index into the plan; none: the goal
  pddl::Microseconds time{0};       ///< says when it shows
  std::string action;               ///< "(drive a b)"; empty for the goal
  std::string condition;            ///< says what does not hold, instantiated; empty if not about a condition
  std::string message;              ///< the whole story in a sentence, without step and time
};

/// Holds the verdict on a plan with everything that it breaks.
struct Report {
  bool valid = false;
  std::vector<Violation> violations;  ///< stand in order of time; later ones may follow from earlier ones
  pddl::Microseconds makespan{0};
  std::optional<double> metric;  ///< is set for a valid plan, if the problem has one
};

/// Prints one line per violation, "plan.txt:3: at 12.500: (drive a b): …", with the line number where the
/// step has one.
std::string to_text(const Report& report, const std::vector<pddl::PlanStep>& plan, std::string_view file);

}  // namespace roci::planner::temporal_pddl::validate
