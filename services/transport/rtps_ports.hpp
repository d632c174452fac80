// This file has the UDP ports of a DDS domain (RTPS 2.2, 9.6.1.1).
#pragma once

namespace roci::services::transport {

/// Returns the first port of a domain: participant p listens at this port + 2 p, and at the one above.
constexpr int first_participant_port(int domain) { return 7400 + 250 * domain + 10; }

/// Bounds the participants of one domain on a host.
inline constexpr int kMaxParticipantsPerHost = 40;

}  // namespace roci::services::transport
