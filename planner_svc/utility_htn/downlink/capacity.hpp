// The capacity of a downlink is how many bytes it can carry, and what bounds it (MEXEC, appendix A: Earth in
// view, energy, heat, rate; R111, R126).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/utility_htn/downlink/manager.hpp"
#include "planner_svc/utility_htn/downlink/packing.hpp"

namespace roci::planner::utility_htn::downlink {

/// Names what bounds the bytes of a downlink.
enum class Bound { earth_in_view, downlink_energy, heat, sol_energy };

/// Says how much one downlink can carry, and what bounds it.
struct Capacity {
  std::uint64_t bytes = 0;
  Bound bound = Bound::earth_in_view;  ///< the tightest
};

/// Returns what a window can carry alone, rounded down to whole bytes.
Capacity capacity(const Window& window, const Limits& limits);

/// Holds the windows as bins, and the limits of those sols that have one, in joules.
struct Bins {
  std::vector<Bin> bins;
  std::vector<double> sol_joules;
};
Bins bins_of(std::span<const Window> windows, const Limits& limits);

/// Returns what sending so many bytes takes; the duration is rounded up to a microsecond.
Load load(const Window& window, std::uint64_t bytes);

/// Throws std::invalid_argument in plain words for what Manager::assign() refuses.
void refuse_impossible(std::span<const Product> products, std::span<const Window> windows,
                       const Limits& limits);

}  // namespace roci::planner::utility_htn::downlink
