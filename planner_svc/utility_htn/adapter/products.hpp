// This file brings data products as planner_svc hears them into the words of the network (R115).
#pragma once

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"

namespace roci::planner::utility_htn::adapter {

/// Returns the primitive task of an activity of ours; as many as the network has tasks if it is none.
model::TaskIndex task_of_activity(const model::Network& network, const std::string& activity);

/// Returns what a product is in the network. One that no task of ours made waits for a downlink like all others. One
/// whose worth was not computed is worth what the network says of its task's product of that name (its kind), or, where
/// the network has none or says nothing, its share of what is predicted of the task.
delivery::Existing existing(const model::Network& network, const flattening::Chains& chains,
                            const cycle::Cycle& cycle, const engine::DataProduct& product);

}  // namespace roci::planner::utility_htn::adapter
