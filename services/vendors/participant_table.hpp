// The participants of a domain that a transport has met, with what each announced.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// Any thread may call all of it. Participants that have left are kept, because their samples may still be under way;
/// of all that were met the newest kKnownParticipants are.
class ParticipantTable {
 public:
  /// `guid` is that of the participant or of one of its writers or readers: they share its first 12 bytes.
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
