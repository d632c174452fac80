// The participant table has the participants of a domain that a transport has met, with what each announced.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// Keeps the newest kKnownParticipants that were met, also those that have left, because their samples may still be
/// under way. Any thread may call it.
class ParticipantTable {
 public:
  /// Adds a participant; `guid` is its own or that of one of its writers or readers, which share its first 12
  /// bytes.
  void add(const transport::Guid& guid, transport::Participant);
  std::optional<transport::Participant> find(const transport::Guid&) const;

  static constexpr std::size_t kKnownParticipants = 1024;

 private:
  using Prefix = std::array<std::uint8_t, 12>;
  static Prefix prefix_of(const transport::Guid&);

  mutable std::mutex mutex_;
  std::map<Prefix, transport::Participant> known_;
  std::deque<Prefix> met_;  // the oldest first
};

}  // namespace roci::services::vendors
