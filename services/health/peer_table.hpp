// Which services are alive, from their heartbeats and from what the transport says of their writers. Wall
// time.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/node/loop.hpp"

namespace roci::services {

class PeerTable {
 public:
  explicit PeerTable(wall::Clock::duration hang_limit) : hang_limit_(hang_limit) {}

  void heartbeat(const v1::Heartbeat&, wall::Instant now);
  // A sign of life other than a heartbeat.
  void seen(const std::string& service, std::uint32_t incarnation, wall::Instant now);
  // The transport knows no living writer of this service's heartbeat any more.
  void owner_lost(const std::string& service);
  void check(wall::Instant now);  // who is silent for too long

  PeerState state(std::string_view service) const;
  std::vector<PeerChange> take_changes();

 private:
  struct Peer {
    std::uint32_t incarnation = 0;
    bool alive = false;
    bool left = false;  // it said that it stops
    wall::Instant last_seen;
  };
  void die(const std::string& service, Peer&, std::string cause);

  wall::Clock::duration hang_limit_;
  std::map<std::string, Peer, std::less<>> peers_;
  std::vector<PeerChange> changes_;
};

}  // namespace roci::services
