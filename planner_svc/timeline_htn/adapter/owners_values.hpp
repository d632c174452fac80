// This file adds to an answer the numbers that services gave for a call: those on which the plan rests, or
// what they say where there is none.
#pragma once

#include <span>
#include <vector>

#include "planner_svc/engine/answer.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::adapter {

/// Returns the values that durations, tests and constraints of the plan that was found read. Where the plan leaves
/// decisions open: all that were given, since an answer may stand on any.
std::vector<temporal::FunctionValueUse> values_of(const search::Search& search,
                                                  const temporal::FlexiblePlan& plan,
                                                  std::span<const engine::FunctionUse> uses);

/// Adds to an answer without a plan what owners said. Where one of them found no value with the effort spent, nothing
/// is proved, and `unsolvable` becomes `timeout`.
void explain(engine::Answer& answer, const model::Model& model, const engine::Request& request,
             std::span<const engine::FunctionUse> uses);

}  // namespace roci::planner::timeline_htn::adapter
