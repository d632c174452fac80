// This file finds for which numbers more, or less, is never worse: dominance between states with different
// numbers rests on it.
#pragma once

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::task {

/// Says which values of a number are at least as good as a given one.
enum class NumericDominance : std::uint8_t {
  none,    ///< nothing depends on the number
  higher,  ///< whatever is possible with a value is possible with any higher one
  lower,
  exact,
};

/// Finds for each number whether more or less of it is never worse, from the signs with which it enters
/// conditions, goals, and effects on other numbers. What durations or equalities depend on is exact. With
/// `metric_counts`, a worse metric is worse too.
IdVector<NumberId, NumericDominance> numeric_dominance(const Task& task, bool metric_counts = false);

}  // namespace roci::planner::temporal_pddl::task
