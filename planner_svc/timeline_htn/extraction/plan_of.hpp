// This file makes the FlexiblePlan of what a search has found.
#pragma once

#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::extraction {

/// Says what a plan is called, and when it begins.
struct Head {
  std::string id;
  std::string prefix;  ///< of the activities' ids, so that no two plans share one
  temporal::Time origin{0};
};

/// Returns the plan of a search that has solved its problem.
///
/// Every component is a timeline of it, with a token for each value: the first begins at the origin, the last ends at
/// the horizon, each ends at the very point at which the next begins (R142). Every state but those of kind default is
/// an activity, with the layer of its component as level and what it is a part of as parent (R130); its start is that
/// of its token, and it must end before the token does (R144, LatenessPolicy::deadline). What is seen of a timeline by
/// it are impacts: its own value, and the default state that follows. Decisions are open (R131).
temporal::FlexiblePlan plan_of(const search::Search& search, const Head& head);

}  // namespace roci::planner::timeline_htn::extraction
