// Random task networks in which all that a network can hold occurs.
#pragma once

#include <random>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn {

/// Returns a network without faults: some five timelines, some ten tasks, parents upon parents among them. The
/// constraints of each task stand in the order of their phases.
model::Network random_network(std::mt19937_64& random);

}  // namespace roci::planner::utility_htn
