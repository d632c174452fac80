// A mission has to end early where its budget does not last (R97, R107).
#pragma once

#include <optional>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/cycle/placement.hpp"

namespace roci::planner::utility_htn::cycle {

/// Holds the new end of what draws all the time.
struct EarlyEnd {
  std::uint32_t load = 0;  ///< number of its block
  temporal::Time end{0};
};

/// Returns the new end of what runs by itself and draws all the time, such as a hotel load, if the budget does not
/// last to the end of the mission, or nothing if it does. Half of what is left is then for being there, and half for
/// tasks, so that what is worth most is done in time. The mission ends early only if the budget does not last by
/// `reported`, its newest report, either: whoever judges the plan knows the report alone, not what was drawn since.
std::optional<EarlyEnd> early_end(const model::Network& network, const model::Values& values,
                                  const temporal::timelines::Timelines& timelines,
                                  const std::vector<Block>& blocks, temporal::Time now, double reported);

}  // namespace roci::planner::utility_htn::cycle
