// Which products are to go with which downlink, as the simulated radios have been told.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Says which products a robot is to send with which downlink, as whoever plans for it wants it now.
struct DownlinkSchedule {
  std::string robot;  ///< empty: the only one
  /// Activity of the downlink → products in the order in which they go: ids of those that exist, and of those that a
  /// planned task will make <…>/<kind>.
  std::map<std::string, std::vector<std::string>> products;
  /// Activity of the downlink → how long it is to last; what is left of that when all its products are
  /// sent is for others on board.
  std::map<std::string, temporal::Duration> lasts{};
};

}  // namespace roci::sim::world
