// The port that a participant sends from, chosen before it is made, because its GUID prefix names it.
#pragma once

#include <cstdint>
#include <fastdds/rtps/common/GuidPrefix_t.hpp>
#include <string>

namespace roci::services::vendors::fastdds {

/// A UDP port of `address` that nobody has. Throws TransportError if there is none.
std::uint16_t free_port(const std::string& address);

/// Whether a socket of this process is bound to the UDP port.
bool is_ours(std::uint16_t port);

/// A prefix that nobody else has, of a participant that sends from this port (guard::prefix_start).
eprosima::fastrtps::rtps::GuidPrefix_t prefix_naming(std::uint16_t port);

/// A prefix of which DDS Security makes one that nobody else has, of a participant that sends from this port
/// (certificate::candidate_naming).
eprosima::fastrtps::rtps::GuidPrefix_t candidate_naming(std::uint16_t port);

}  // namespace roci::services::vendors::fastdds
