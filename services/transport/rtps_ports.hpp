// The UDP ports of a DDS domain (RTPS 2.2, 9.6.1.1).
#pragma once

namespace roci::services::transport {

/// Participant p of a domain listens at this port + 2 p, and at the one above.
constexpr int first_participant_port(int domain) { return 7400 + 250 * domain + 10; }

/// How many participants of one domain a host may have.
inline constexpr int kMaxParticipantsPerHost = 40;

}  // namespace roci::services::transport
