// Which services are alive, from their heartbeats and from what the transport says of their writers. Wall
// time.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"
#include "services/health/peer.hpp"

namespace roci::services::health {

class PeerTable {
 public:
  explicit PeerTable(clock::WallDuration hang_limit) : hang_limit_(hang_limit) {}

  void heartbeat(const v1::Heartbeat&, clock::WallTime now);
  // A sign of life other than a heartbeat.
  void seen(const std::string& service, std::uint32_t incarnation, clock::WallTime now);
  // The transport knows no living writer of this service's heartbeat any more.
  void owner_lost(const std::string& service);
  void check(clock::WallTime now);  // who is silent for too long

  PeerState state(std::string_view service) const;
  std::vector<PeerChange> take_changes();

 private:
  struct Peer {
    std::uint32_t incarnation = 0;
    bool alive = false;
    bool left = false;  // it said that it stops
    clock::WallTime last_seen;
  };
  void die(const std::string& service, Peer&, std::string cause);

  clock::WallDuration hang_limit_;
  std::map<std::string, Peer, std::less<>> peers_;
  std::vector<PeerChange> changes_;
};

}  // namespace roci::services::health
