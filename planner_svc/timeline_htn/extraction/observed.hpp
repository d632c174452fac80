// This file says what is observed of the states of a model, as values and conditions for readers that never
// saw the model.
#pragma once

#include <vector>

#include "core/temporal/condition.hpp"
#include "planner_svc/timeline_htn/search/ground.hpp"

namespace roci::planner::timeline_htn::extraction {

/// Returns the value that is seen of a state with these objects.
temporal::Value observed_value(const model::Model& model, const model::Observed& observed,
                               const std::vector<search::Index>& objects);

/// Returns the value that is seen of a state that is observed.
temporal::Value observed_value(const search::Ground& ground, search::StateId state);

/// Returns that the state is seen; nothing where it is not observed.
temporal::Condition observed_condition(const search::Ground& ground, search::StateId state);

/// Returns what is seen where a need of a state is met, as its timeline is observed. Its free names may be any object:
/// all of them where they are all that is seen of the state or make up too many alternatives, else one after the other.
temporal::Condition met_condition(const search::Ground& ground, search::StateId needing,
                                  const model::Need& need, const model::Observed& observed);

}  // namespace roci::planner::timeline_htn::extraction
