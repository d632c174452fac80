// The failure detector tells which services are alive, from their heartbeats and from what the transport says
// of their writers. It is an unreliable failure detector (Chandra and Toueg, 1996), which may suspect a
// service that is only slow. Its time is wall time.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"
#include "services/health/peer.hpp"

namespace roci::services::health {

/// Holds the state of each service and tells of each change once.
///
/// The incarnation that is heard counts. Another one replaces it only when it has been silent: a later one after
/// kStillHeard; an earlier one, or one more than kIncarnationJump later, after the limit for a hang. A forged
/// heartbeat thus replaces nobody who is heard, and a service that it has replaced comes back. Who says that it stops
/// has left once nothing more is heard of it for kStillHeard, or its writer is gone: a service's last heartbeat says
/// so, and another one behind it shows that it was forged.
class FailureDetector {
 public:
  /// Says how lately a service must have been heard to count as running; heartbeats come four times a second.
  static constexpr clock::WallDuration kStillHeard = std::chrono::milliseconds(600);
  /// Bounds the believable jump of incarnations: no service is started so often while nobody hears of it.
  static constexpr std::uint32_t kIncarnationJump = 1000;

  explicit FailureDetector(clock::WallDuration hang_limit) : hang_limit_(hang_limit) {}

  /// Returns false, and takes in nothing, for a service that is new when kPeers are known (bounds/limits.hpp).
  bool heartbeat(const v1::Heartbeat&, clock::WallTime now);
  /// Takes in that something other than a heartbeat has shown that the service lives.
  void seen(const std::string& service, std::uint32_t incarnation, clock::WallTime now);
  /// Takes in that the transport no longer knows a living writer of this service's heartbeat.
  void writer_lost(const std::string& service);
  /// Declares dead whoever has been silent for longer than the limit, or kStillHeard after it said that it stops.
  void check(clock::WallTime now);

  PeerState state(std::string_view service) const;
  std::vector<PeerChange> take_changes();

 private:
  struct Peer {
    std::uint32_t incarnation = 0;
    bool alive = false;
    clock::WallTime last_seen;
    std::optional<clock::WallTime> stopping_since;  // it said that it stops, and no heartbeat came since
  };
  bool believable(const Peer&, std::uint32_t incarnation, clock::WallTime now) const;
  void die(const std::string& service, Peer&, std::string cause);

  clock::WallDuration hang_limit_;
  std::map<std::string, Peer, std::less<>> peers_;
  std::vector<PeerChange> changes_;
};

}  // namespace roci::services::health
