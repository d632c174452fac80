// Where a mission has to end because its budget does not last (R97, R107).
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

/// Looks at what runs by itself and draws all the time, as a hotel load, planned to the end of the mission. Where the
/// budget does not last so long, the mission ends before: half of what is left is for being there, and half for having
/// something to do, so that what is worth most is done in time. It ends before only where the budget does not last by
/// `reported` either, its newest report: what was drawn since then does not decide that, as who judges the plan knows
/// the report alone. Nothing: the budget lasts.
std::optional<EarlyEnd> early_end(const model::Network& network, const model::Values& values,
                                  const temporal::timelines::Timelines& timelines,
                                  const std::vector<Block>& blocks, temporal::Time now, double reported);

}  // namespace roci::planner::utility_htn::cycle
