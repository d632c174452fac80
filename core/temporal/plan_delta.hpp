// A plan delta says what changes from one version of a plan to the next: so an engine that plans all the time
// sends its plan (R66, R81).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Holds the change. The time points of what stays keep their numbers from version to version; those of removed
/// activities may be given to new ones, in the same change or later, so that a plan that never ends needs no more
/// points than it holds at once.
struct PlanDelta {
  std::uint32_t from_version = 0;  ///< version of the plan that changes; 0: none, `added` is the whole plan
  /// Holds id, version, engine, origin, number of points and function values as they become, and activities,
  /// tokens, decisions and constraints that are new. An activity or decision stands in place of that with its
  /// id.
  FlexiblePlan added;
  std::vector<std::string> removed_activities;
  std::vector<std::string> removed_decisions;
  std::vector<Token> removed_tokens;                    ///< one of each that is equal
  std::vector<TemporalConstraint> removed_constraints;  ///< likewise
  friend bool operator==(const PlanDelta&, const PlanDelta&) = default;
};

/// Returns what turns `from` into `to`, but for the order of their items.
PlanDelta difference(const FlexiblePlan& from, const FlexiblePlan& to);

/// Changes the plan; items that stay keep their order, new ones follow. Returns what is wrong (another
/// version than the delta is of, an item to be removed that is not there), and the plan has then not changed;
/// the text is empty if nothing is.
std::string apply(const PlanDelta& delta, FlexiblePlan& plan);

}  // namespace roci::temporal
