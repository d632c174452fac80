// What the plain messages of a secure run say of whom: where participants are spoken to, and how handshakes go on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "services/vendors/guard/identities.hpp"

namespace roci::services::vendors::guard {

/// Where a participant says that it is to be spoken to.
struct Announcement {
  GuidPrefix prefix{};
  std::vector<Source> reached_at;
};

/// Returns the announcement of a participant in a message that passed (examine),
/// if it has one with unicast IPv4 locators.
std::optional<Announcement> announcement_in(std::span<const std::uint8_t> message);

/// Is what a message of a handshake is about (DDS Security 1.1, 9.3.2.5): it begins one, or answers.
struct HandshakePart {
  bool begins = false;
  GuidPrefix with{};  ///< for whom it is
};

/// Returns the handshakes that a message of this process is about.
std::vector<HandshakePart> handshakes_in(std::span<const std::uint8_t> message);

}  // namespace roci::services::vendors::guard
