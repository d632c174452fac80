// The heartbeat of a service goes out from its work loop: the loop itself calls beat(), so that a hung loop
// goes silent.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"

namespace roci::services::health {

/// Sends a heartbeat every quarter of a second as long as its loop turns.
class HeartbeatSender {
 public:
  using Send = std::function<void(const v1::Heartbeat&)>;

  /// `identity` says who beats (service, incarnation, mission, robot, vendor); the rest is filled in here.
  HeartbeatSender(v1::Heartbeat identity, Send);

  /// The loop calls it in each of its turns; it sends when it is time. A degraded service works, but not as it
  /// should: SERVICE_DEGRADED.
  void beat(clock::WallTime now, bool degraded = false);
  /// Returns who beats.
  const v1::Heartbeat& identity() const { return beat_; }
  /// Sends the last heartbeat, SERVICE_STOPPING.
  void leave();
  clock::WallTime next() const { return next_; }

 private:
  void send(v1::ServiceState);

  Send send_;
  v1::Heartbeat beat_;
  std::uint64_t turns_ = 0;
  clock::WallTime next_;
};

}  // namespace roci::services::health
