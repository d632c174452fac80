// Random tasks in whose conditions and effects there is a choice.
#pragma once

#include <random>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::testing {

// A random_task() with disjunctions among the conditions at the start and at the end, some decided by what
// never changes; with `conditional`, some effects depend on conditions, too.
Model random_choices_task(std::mt19937_64& random, bool conditional);

}  // namespace roci::planner::temporal_pddl::testing
