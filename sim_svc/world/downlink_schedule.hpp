// The downlink schedule says which products are to go with which downlink, as the simulated radios have been
// told.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Says which products a robot is to send with which downlink, as whoever plans for it wants it now.
struct DownlinkSchedule {
  std::string robot;  ///< empty: the only one
  /// Maps the activity of a downlink to products in the order in which they go: ids of those that exist, and
  /// <…>/<kind> of those that a planned task will make.
  std::map<std::string, std::vector<std::string>> products;
  /// Maps the activity of a downlink to how long it is to last; what is left of that when all its products
  /// are sent is for others on board.
  std::map<std::string, temporal::Duration> lasts{};
};

}  // namespace roci::sim::world
