// This file stands between Cyclone DDS and its sockets: where they are bound, and what it reads from them.
//
// Cyclone DDS 0.10 binds its receiving sockets to 0.0.0.0 whatever is configured (ddsi_udp.c: bind_to_any), so that
// every host that reaches this one could speak to it. Here they are bound to the one configured address, and each
// datagram passes a guard before its parser, and in a secure run what is sent, too. Participants are named after the
// port that they send from.
#pragma once

#include <memory>
#include <optional>

#include "services/vendors/guard/guard.hpp"

namespace roci::services::vendors::cyclonedds {

/// Gives every socket that this thread lets Cyclone DDS bind, while this object lives, to `guard`, and binds it to
/// `address` (IPv4, in host byte order) where the vendor asked for any; without an address it stays as the vendor wants
/// it. In a `secure` domain every participant has a GUID prefix of which its certificate makes one that names the port.
/// Throws TransportError if the library cannot be guarded: nothing is opened unguarded.
class GuardedOpening {
 public:
  GuardedOpening(std::shared_ptr<guard::Guard> guard, std::optional<std::uint32_t> address, bool secure);
  ~GuardedOpening();
  GuardedOpening(const GuardedOpening&) = delete;
  GuardedOpening& operator=(const GuardedOpening&) = delete;

  /// Returns how many sockets were bound.
  int bound() const;
};

}  // namespace roci::services::vendors::cyclonedds
