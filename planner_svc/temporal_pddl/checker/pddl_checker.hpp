// The independent validator as the checker of the plans that leave the engine.
#pragma once

#include "planner_svc/engine/checker.hpp"

namespace roci::planner::temporal_pddl::checker {

/// Takes the plan's earliest schedule, reads actions and objects off its activities ("1", "2", … are the
/// objects), and executes that on the syntax tree of the request's domain and problem, with the function
/// values as the owners gave them. The goals that activities say they serve must be those of the request.
class PddlChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override;
};

}  // namespace roci::planner::temporal_pddl::checker
