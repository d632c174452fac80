// Random tasks whose conditions hang on derived predicates.
#pragma once

#include <random>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::testing {

// A random_task() in which some of the facts in conditions and goals are derived, by disjunctions,
// conjunctions and negations of facts, numbers and other derived ones; without recursion.
Model random_derived_task(std::mt19937_64& random);

}  // namespace roci::planner::temporal_pddl::testing
