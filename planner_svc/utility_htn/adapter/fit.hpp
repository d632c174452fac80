// This file finds what of a plan made with another network the network in force can go on with.
#pragma once

#include <cstdint>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::planner::utility_htn::adapter {

/// Holds a plan as far as the network in force can go on with it, and what is gone of it.
struct Fitted {
  temporal::FlexiblePlan plan;               ///< that recover() takes
  std::vector<temporal::PlanActivity> gone;  ///< of blocks that the network does not have
  std::uint32_t last_block = 0;              ///< of the whole plan: its numbers are never used again
  bool foreign = false;                      ///< something is gone
};

/// Leaves out blocks of chains, and what was remembered of tasks, parameters and timelines,
/// that the network does not have.
Fitted fit(const model::Network& network, const flattening::Chains& chains,
           const temporal::FlexiblePlan& plan);

}  // namespace roci::planner::utility_htn::adapter
