// A task may claim a resource that only one or a few may hold at a time; this file says when claims are given
// back or begin again.
#pragma once

#include <vector>

#include "planner_svc/utility_htn/cycle/placement.hpp"

namespace roci::planner::utility_htn::cycle {

/// Returns when what `waiting`, a link of these blocks, claims is given back by all that runs, and by all that waits
/// longer than it does; 0 where nothing is taken.
temporal::Time free_from(const model::Network& network, const model::Values& values,
                         const std::vector<Block>& blocks, const Link& waiting);

/// Returns when something begins behind the link that claims what the link claims and does not give way, as it is fixed
/// or committed; without bound where nothing does.
temporal::Time free_until(const model::Network& network, const std::vector<Block>& blocks, const Link& of);

}  // namespace roci::planner::utility_htn::cycle
