// A number without an initial value is undefined until an effect assigns one (Fox and Long 2003, section 3.1):
// what reads it before neither holds nor happens.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Names a number without an initial value that some condition, effect or duration reads.
struct UndefinedNumber {
  task::NumberId number;
  std::uint32_t has_value = 0;  ///< the atom that is true from the first assignment on
  bool assigned = false;        ///< whether any effect or timed change assigns it
};

/// Makes it a fact, "(has-value:fuel r)", whether such a number has a value: assignments add it, and whatever
/// reads the number asks for it. So nothing after this need know of undefined numbers. Where all numbers
/// begin with a value it does nothing.
std::vector<UndefinedNumber> require_values(instantiation::GroundModel& model, lifted::Symbols& symbols);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
