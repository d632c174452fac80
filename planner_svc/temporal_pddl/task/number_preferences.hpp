// For which numbers more, or less, is never worse: what numeric dominance rests on.
#pragma once

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

enum class Preference : std::uint8_t {
  kNone,    // nothing depends on the number
  kHigher,  // whatever is possible with a value is possible with any higher one
  kLower,
  kExact,
};

// By number: from the signs with which it enters conditions, goals, and effects on other numbers. What
// durations or equalities depend on is kExact.
IdVector<NumberId, Preference> number_preferences(const Task& task);

}  // namespace roci::planner::temporal_pddl
