// Plans of any size in the shapes that matter to the cost of an event.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::bench {

/// chain: each activity after the one before it. rigid: a chain whose gaps are bounded from above too, as in
/// R142. fan: eight at a time, then a join, again and again. random: each activity after up to three of the
/// twenty before it; one gap in ten is bounded from above.
const std::vector<std::string>& shapes();

/// Activities of 10 s that an owner "sim" executes; the end of the plan has a deadline with some slack.
/// Throws std::invalid_argument for an unknown shape.
temporal::FlexiblePlan plan_of(const std::string& shape, std::size_t activities, std::mt19937_64& random);

}  // namespace roci::bench
