// The checker puts the numbers that services gave for the call into its own model, and compares them with what the
// plan records.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::checking {

/// Puts the exact values into the tables that are asked for.
void put_values(std::span<const engine::FunctionUse> values, model::Model& model);

/// Notes each value that the plan records and its owner did not give so, and each that a state of the plan reads and
/// the plan does not record. The plan has no other fault.
void check_values(const model::Model& model, const temporal::FlexiblePlan& plan,
                  std::span<const engine::FunctionUse> values, std::vector<std::string>& out);

}  // namespace roci::planner::timeline_htn::checking
