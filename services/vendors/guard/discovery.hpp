// The plain messages of a secure run say where participants are reached, and how handshakes go on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "services/vendors/guard/identities.hpp"

namespace roci::services::vendors::guard {

/// Says where a participant announces that it is reached.
struct Announcement {
  GuidPrefix prefix{};
  std::vector<Source> reached_at;
};

/// Returns the announcement of a participant in a message that passed examine(), if it has one with unicast
/// IPv4 locators.
std::optional<Announcement> announcement_in(std::span<const std::uint8_t> message);

/// Says what a message of a handshake does (DDS Security 1.1, 9.3.2.5): it begins one, or answers.
struct HandshakePart {
  bool begins = false;
  GuidPrefix with{};  ///< participant that it is for
};

/// Returns the handshakes that a message of this process is about.
std::vector<HandshakePart> handshakes_in(std::span<const std::uint8_t> message);

}  // namespace roci::services::vendors::guard
