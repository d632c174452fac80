// This file extracts the choices that a plan leaves open to whoever resolves them at run time (R131).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::extraction {

/// Says where the activities and time points of a partial plan stand in the plan that is made of it.
struct Numbering {
  std::string prefix;                       ///< of the activities' ids
  std::vector<search::Index> shown;         ///< by activity: its number; kNone: it is not shown
  std::vector<temporal::TimePoint> points;  ///< by time point
  /// Lists activities that stand for none of the partial plan: their starts in it, and their ids.
  std::vector<std::pair<search::TimePoint, std::string>> marks;

  std::string id(std::size_t number) const { return prefix + std::to_string(number); }
  /// Returns the id of an activity of the partial plan that is shown.
  std::string id_of(search::Index activity) const { return id(shown[activity]); }
};

/// Returns the decisions of all behaviours of a plan that was found, in the order of its activities. A choice names
/// the activities that it stands for, and those behind the decision that only it leads to; a value to be bound, the
/// arguments that take it and the objects that it may be.
std::vector<temporal::DecisionPoint> decision_points(const search::Search& search,
                                                     const Numbering& numbering);

}  // namespace roci::planner::timeline_htn::extraction
