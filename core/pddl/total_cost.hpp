// (total-cost) is the one fluent that needs no initial value: problems of the competitions count with it from
// 0 on, whether they say so or not.
#pragma once

#include <algorithm>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

inline constexpr const char* kTotalCost = "total-cost";

/// Returns whether the domain declares a fluent `total-cost` without parameters. It is 0 at first where the
/// problem says nothing else.
inline bool has_total_cost(const Domain& domain) {
  return std::ranges::any_of(domain.functions, [](const Signature& function) {
    return function.name == kTotalCost && function.parameters.empty();
  });
}

}  // namespace roci::pddl
