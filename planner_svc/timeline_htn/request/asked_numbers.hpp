// This file asks services for numbers of a model (R35, R36) before the search, table by table, through the
// port that every engine has.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/verdict.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::request {

/// Holds what owners said, and why nothing can be planned with it.
struct Asked {
  std::vector<engine::FunctionUse> uses;
  /// solved: every number came, or is known not to exist, or was not found; such a one has no row.
  temporal::Verdict verdict = temporal::Verdict::solved;
  std::string reason;  ///< with the place of the table and a remedy
};

/// Asks for all numbers of each table that is asked for, exactly, in one batch for each, and puts them into the model;
/// a table of more than kMostAsked is refused and nobody is asked for it.
/// The objects and rows of the request stand in the model already.
Asked ask_numbers(model::Model& model, engine::FunctionSource& functions,
                  const std::function<bool()>& cancelled);

/// Puts the numbers that a plan records into the model, for who may ask nobody.
void put_recorded(const std::vector<temporal::FunctionValueUse>& recorded, model::Model& model);

}  // namespace roci::planner::timeline_htn::request
