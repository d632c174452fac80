// Small random temporal tasks: envelopes, invariants, conditions at ends, numbers, timed literals, flexible
// durations.
#pragma once

#include <random>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::testing {

// Predicates and actions have no parameters; durations and times are whole seconds.
// shortest: of the durations, in seconds.
Model random_task(std::mt19937_64& random, int shortest = 0);

}  // namespace roci::planner::temporal_pddl::testing
