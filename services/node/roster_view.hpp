// The roster view is the roster as one simulated node has shown it to its handlers. It is pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "roci_idl/clock.h"
#include "services/health/peer.hpp"

namespace roci::services::node {

bool contains(const std::vector<v1::RosterEntry>&, std::string_view service, std::uint32_t incarnation);

/// Turns the rosters of clock steps into changes, each reported once.
class RosterView {
 public:
  /// Returns what has changed since the last step for a node of name `self`: deaths first, each by name.
  std::vector<health::PeerChange> update(const v1::ClockStep&, std::string_view self);
  health::PeerState state(std::string_view service) const;

 private:
  bool known_ = false;
  std::map<std::string, std::uint32_t, std::less<>> alive_;
};

}  // namespace roci::services::node
