// This file makes plans of any size in the shapes that matter to the cost of an event.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::bench {

/// Returns the names of the shapes. In a chain, each activity comes after the one before it. A rigid plan is
/// a chain whose gaps are bounded from above too, as in R142. A fan has eight at a time, then a join, again
/// and again. In a random plan, each activity comes after up to three of the twenty before it, and one gap in
/// ten is bounded from above.
const std::vector<std::string>& shapes();

/// Returns a plan of activities of 10 s that an owner "sim" executes; the end of the plan has a deadline with
/// some slack. Throws std::invalid_argument for an unknown shape.
temporal::FlexiblePlan plan_of(const std::string& shape, std::size_t activities, std::mt19937_64& random);

}  // namespace roci::bench
