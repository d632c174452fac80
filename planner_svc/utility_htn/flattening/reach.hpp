// This file finds the requests that nothing leads to any more, whatever is planned (R112, R117).
#pragma once

#include <set>
#include <span>
#include <vector>

#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::planner::utility_htn::flattening {

/// Says what may still come to pass.
struct Prospects {
  std::span<const double> timelines_now;      ///< newest values, by timeline Index
  const std::set<model::TaskIndex>& open;     ///< requests that may be planned
  std::vector<model::TaskIndex> under_way{};  ///< primitive tasks that are placed already and have not ended
};

/// Returns the requests of `open` of which no chain can run: each asks for a state that its timeline does not have now,
/// and that nothing which is under way or open and possible itself brings about. So a site whose excavation was given
/// up takes its samples with it.
///
/// This is the delete relaxation (Bonet and Geffner 2001): a state that was once reached counts as lasting, numbers
/// count as in range, and a chain may use what its own tasks assign, in whatever order. Hence what is returned cannot
/// be placed, while what is not returned may still find no place. A timeline that no task of the network assigns may
/// take any state at any time, as the ground's word.
std::set<model::TaskIndex> out_of_reach(const model::Network& network, const Chains& chains,
                                        const model::Values& values, const Prospects& prospects);

}  // namespace roci::planner::utility_htn::flattening
