// This file finds the earliest schedule of a whole network at once.
#pragma once

#include <optional>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Returns the earliest time of each point, none before 0, that satisfies every constraint, or nothing if no
/// schedule does. It goes by Bellman and Ford in Yen's order (1970): each sweep follows the topological order
/// of the orderings, so one is enough where upper bounds hold by themselves, and more than there are points
/// mean a circle that nothing satisfies.
std::optional<std::vector<Duration>> earliest_schedule(std::size_t point_count,
                                                       const std::vector<TemporalConstraint>& constraints);

}  // namespace roci::temporal
