// A service knows this of the other services of its run.
#pragma once

#include <cstdint>
#include <string>

namespace roci::services::health {

/// Says whether a service is there, as another one knows it.
enum class PeerState { never_seen, alive, dead };

/// Describes a change of the roster as a service sees it; it is delivered in mission-time order, like a
/// sample.
struct PeerChange {
  std::string service;
  std::uint32_t incarnation = 0;
  bool alive = false;
  std::string cause;  ///< how it died: "killed", "hung", "left" or "restarted"
};

}  // namespace roci::services::health
