// Which values of external functions an activity of a plan stands on.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Returns the indices of the values that an action with these arguments stands on, in the order of `values`. A plan
/// does not say so itself: it is told by the names. Of each function these are the values whose arguments all stand
/// among the action's, in their order ((f a b) for (act a m b)); where it has none,
/// those whose arguments stand there in another order.
std::vector<std::size_t> function_values_of(const std::vector<std::string>& arguments,
                                            std::span<const FunctionValueUse> values);

}  // namespace roci::temporal
