// First fit is the cheapest certificate that data have room: one assignment (R110, R127). The search asks for every
// candidate, so most answers must come without sorting lists again and again.
#pragma once

#include <span>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::delivery {

/// Returns true when it has found a downlink for every product but Residual ones: Critical and Decisional products in
/// the first window after their creation, Mandatory ones in any after it. False says nothing. The windows are in order
/// of their starts; limits of energy are not looked at.
bool first_fit(std::span<const model::DataProduct> standing, std::span<const model::DataProduct> candidates,
               std::span<const downlink::Window> windows);

}  // namespace roci::planner::utility_htn::delivery
