// Flexible timelines have this form (R142; SanchoExpress, section 5.1): the values of a timeline stand in order,
// without gap or overlap, from the origin to the horizon.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Returns everything that keeps the plan's tokens from being flexible timelines, one plain sentence each. Tokens that
/// name the same timeline are its values in the order of the list. In every schedule of the plan's own network
///  - each value begins when the one before it ends: the two points are one, or fixed to each other;
///  - the first begins at the origin, in [O, O];
///  - the last ends at `horizon`, in [H, H], which counts from the origin.
/// [min, max] between two neighbouring points must not contradict each other or the rest of the network; if they do,
/// that is the only fault told, since nothing has a time then. Points must be below point_count, as check() says.
std::vector<std::string> timeline_faults(const FlexiblePlan& plan, Duration horizon);

}  // namespace roci::temporal
