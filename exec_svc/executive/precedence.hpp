// Precedence says which time points must have happened before which.
#pragma once

#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::executive {

/// Says what makes a time point happen.
enum class PointRole : char {
  free,          ///< the network alone: the end of a token that no activity owns
  start,         ///< the executive starts an activity
  internal_end,  ///< the executive ends an activity without command
  observed_end,  ///< the owner of a command reports its end: contingent
};

/// Says whose a time point is.
struct PointOwner {
  PointRole role = PointRole::free;
  std::size_t activity = 0;  ///< not for free points
};

/// Returns the owner of every time point of the plan.
std::vector<PointOwner> point_owners(const temporal::FlexiblePlan& plan);

/// Holds which points precede which: q precedes p if the network holds t[p] >= t[q] by one constraint
/// (ordering, duration or window; the origin precedes nothing, it has happened). Points that such constraints
/// hold together at one time, in a circle, form a group: each waits for the predecessors of all; all wait for
/// the observed ends among them, which nobody can command; free points and internal ends wait for the starts
/// among them, which may have conditions.
struct Precedence {
  std::vector<std::vector<temporal::TimePoint>> predecessors;  ///< are indexed by point, and sorted
  std::vector<std::vector<temporal::TimePoint>> successors;
  std::vector<std::vector<temporal::TimePoint>> together;  ///< the other starts in the group of a start
};

/// Finds the precedence of a network's points; `owners` has one entry per point.
Precedence precedence_of(const std::vector<temporal::TemporalConstraint>& constraints,
                         const std::vector<PointOwner>& owners);

}  // namespace roci::exec::executive
