// A matrix shows a plan as values (R143): plan[i][j] is the value of timeline i from transition j on, where a
// transition is a time point at which at least one timeline changes. It is made from a FlexiblePlan alone, whoever made
// that.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::timeline_htn::extraction {

/// Describes a time point at which at least one timeline changes.
struct Transition {
  std::vector<temporal::TimePoint> points;  ///< that the network holds together
  temporal::Window window;                  ///< from the plan's origin
};

/// Holds a plan as a matrix of values (R143).
struct Matrix {
  std::vector<std::string> timelines;
  std::vector<Transition> transitions;  ///< in the order of their earliest times; the first is the origin
  /// Holds the values by timeline and transition; none: nothing is planned then.
  std::vector<std::vector<temporal::Value>> values;
  std::vector<std::vector<bool>> changes;  ///< whether the timeline changes at the transition
};

/// Returns the matrix of a plan that has passed check(). Of values that stand at one time on one
/// timeline the later one counts.
Matrix matrix_of(const temporal::FlexiblePlan& plan);

/// Writes it as lines of words, one for each transition; a value stands where it begins.
std::string to_text(const Matrix& matrix);
/// Writes one object: timelines, transitions ({earliest_s, latest_s}), plan (rows of values as words,
/// null where nothing is planned).
std::string to_json(const Matrix& matrix);
/// Draws it: a row for each timeline, a column for each transition.
std::string to_svg(const Matrix& matrix, const std::string& title);

}  // namespace roci::planner::timeline_htn::extraction
