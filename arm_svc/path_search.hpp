// Joint-space paths come from OMPL's RRTConnect (Kuffner, LaValle, ICRA 2000).
//
// They are deterministic: every sample comes from a generator seeded by the query alone (OMPL's own seed is
// process-wide), the nearest neighbour search is exact, and the budget is iterations, so that neither earlier
// queries nor the speed of the machine change a path.
#pragma once

#include <functional>
#include <variant>
#include <vector>

#include "arm_svc/collision.hpp"
#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// A path is way-points joined by straight joint-space lines.
using JointPath = std::vector<kinematics::JointVector>;

/// Says why the search found no path.
enum class SearchFailure { budget_spent, cancelled };

/// Bounds a search by work, never by time.
struct SearchBudget {
  unsigned iterations = 2000;
  std::function<bool()> cancelled;  ///< It is asked often, and may be empty.
};

/// Finds a path. `from` and `to` must be within the limits and free of contact. The straight line is tried
/// first.
std::variant<JointPath, SearchFailure> find_path(const kinematics::Arm& arm, const CollisionChecker& checker,
                                                 const kinematics::JointVector& from,
                                                 const kinematics::JointVector& to,
                                                 const SearchBudget& budget);

}  // namespace roci::arm
