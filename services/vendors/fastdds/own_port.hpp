// The port that a participant sends from is chosen before the participant is made, because its GUID prefix
// names the port.
#pragma once

#include <cstdint>
#include <fastdds/rtps/common/GuidPrefix_t.hpp>
#include <string>

namespace roci::services::vendors::fastdds {

/// Returns a free UDP port of `address`. Throws TransportError if there is none.
std::uint16_t free_port(const std::string& address);

/// Returns whether a socket of this process is bound to the UDP port.
bool is_ours(std::uint16_t port);

/// Returns a prefix that nobody else has, for a participant that sends from this port (guard::prefix_start).
eprosima::fastrtps::rtps::GuidPrefix_t prefix_naming(std::uint16_t port);

/// Returns a prefix of which DDS Security makes one that nobody else has, for a participant that sends from
/// this port (certificate::candidate_naming).
eprosima::fastrtps::rtps::GuidPrefix_t candidate_naming(std::uint16_t port);

}  // namespace roci::services::vendors::fastdds
