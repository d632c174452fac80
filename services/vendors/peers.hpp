// The network transports share whom they ask for participants, and how fast they notice that one has died.
#pragma once

#include <string>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

inline constexpr int kLeaseSeconds = 3;  ///< a killed participant is noticed after at most this time

bool is_loopback(const std::string& address);

/// Returns options.peers and options.address itself, each once. On a network the loopback default is left
/// out.
std::vector<std::string> peers_of(const transport::TransportOptions&);

/// Throws TransportError when no running interface of this host has options.address, or it or a peer is no
/// IPv4 address.
void require_usable_addresses(const transport::TransportOptions&);

}  // namespace roci::services::vendors
