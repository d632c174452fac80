// This file finds the values of external functions on which an activity of a plan rests.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Returns the indices of the values on which an action with these arguments rests, in the order of `values`. The
/// plan does not say so, so the names decide: of each function these are the values whose arguments all occur among
/// the action's, in their order ((f a b) for (act a m b)), or, where it has none, those whose arguments occur there
/// in another order.
std::vector<std::size_t> function_values_of(const std::vector<std::string>& arguments,
                                            std::span<const FunctionValueUse> values);

}  // namespace roci::temporal
