// Random consistent plans: constraints drawn around a hidden schedule that satisfies them.
#pragma once

#include <random>

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::testing {

/// 1 to `most` activities (some without command) with random duration bounds, orderings between any of their
/// points, minimal and maximal distances, and windows. Times are whole milliseconds.
temporal::FlexiblePlan random_plan(std::mt19937_64& random, std::size_t most);

/// Uniform in [low, high].
std::int64_t between(std::mt19937_64& random, std::int64_t low, std::int64_t high);

}  // namespace roci::exec::testing
