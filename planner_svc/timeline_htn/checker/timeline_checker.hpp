// The checker of hierarchical timelines at planner_svc's seam.
#pragma once

#include "planner_svc/engine/checker.hpp"

namespace roci::planner::timeline_htn::checker {

/// Checks a plan against the request's model and problem, with checking::faults(); it sees nothing of the search.
class TimelineChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override;
};

}  // namespace roci::planner::timeline_htn::checker
