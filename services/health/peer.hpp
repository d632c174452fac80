// A service knows this of the other services of its run.
#pragma once

#include <cstdint>
#include <string>

namespace roci::services::health {

enum class PeerState { never_seen, alive, dead };

/// Is a change of the roster as a service sees it; it is delivered in mission-time order, like a sample.
struct PeerChange {
  std::string service;
  std::uint32_t incarnation = 0;
  bool alive = false;
  std::string cause;  ///< Says how it died: "killed", "hung", "left" or "restarted".
};

}  // namespace roci::services::health
