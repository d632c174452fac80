// This file says in words for people on the ground why a product is not sent, or not in time.
#pragma once

#include <span>
#include <string>

#include "planner_svc/utility_htn/downlink/capacity.hpp"
#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::downlink {

std::string words(Bound bound);
std::string words(model::Tier tier);

/// Returns why a product stays on board. `first` is the first window that starts after its creation, and `loads` is
/// what the windows carry in the end.
LeftOut left_out(std::span<const Product> products, std::size_t product, std::span<const Window> windows,
                 const Limits& limits, std::size_t first, std::span<const Load> loads);

/// Returns why a product with no choice goes later than its window; `taken` is what that one carries before it.
std::string why_late(const Product& product, const Window& due, const Capacity& capacity,
                     std::uint64_t taken);

}  // namespace roci::planner::utility_htn::downlink
