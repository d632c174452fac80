// This is the independent checker behind planner_svc's seam.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/checker.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::checking {

/// Checks plans of hierarchical timelines against the model and the problem of their request, which it reads anew.
class TimelineChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override;
};

/// Returns the model with the request in place of its own problem, or notes why there is none. Where a component stands
/// is found by trying all its states until one shows as what was observed; a goal is a state that shows as what the
/// goal compares with, or several. `values` are the numbers that services gave.
std::optional<model::Model> model_of(const engine::Request& request, std::vector<std::string>& out,
                                     std::span<const engine::FunctionUse> values = {});

}  // namespace roci::planner::timeline_htn::checking
