// Random questions for the Downlink Manager: windows of a lander that sees Earth for half of every 84
// hours, and data of any size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::bench::downlink {

using Random = std::mt19937_64;

/// Draws windows of 20 to 60 minutes at 5 to 50 kbit/s; three to a sol, each sol with an energy limit below what its
/// windows could take, some with limits of heat and energy of their own.
std::vector<planner::utility_htn::downlink::Window> draw_windows(
    Random& random, std::size_t count, planner::utility_htn::downlink::Limits& limits);

/// Returns how many bytes the windows can carry, without the limits of sols.
double capacity(const std::vector<planner::utility_htn::downlink::Window>& windows);

/// Draws products that are created at any time of the mission and together ask for `demand` bytes: mostly Mandatory, a
/// tenth Residual, a hundredth each Critical and Decisional. One in three is an analysis and has a score of the second
/// of seven ranks; the others have scores of one lower rank each.
std::vector<planner::utility_htn::downlink::Product> draw_products(Random& random, std::size_t count,
                                                                   double demand, temporal::Time until);

}  // namespace roci::bench::downlink
