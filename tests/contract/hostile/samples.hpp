// Samples that no honest writer sends, each well-formed as far as RTPS goes: they reach the reader of a topic.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/contract/hostile/participant.hpp"

namespace roci::services::contract::hostile {

/// Sends through one writer, with the sequence numbers from 1 on.
class HostileWriter {
 public:
  HostileWriter(const Participant& participant, Entity writer, Bytes good, Bytes of_another_type);

  /// All attacks: payloads that are cut, whose lengths are 2^31, whose enumerators and representations nobody knows, of
  /// another type; without a key, with a wrong key hash; ends of instances without a key hash; fragments.
  void attack();
  /// All of it again, as a transient-local writer does for who joins late.
  void repeat() const;

 private:
  void payloads();
  void keys();
  void ends();
  void fragments();
  void data(std::uint8_t flags, const Bytes& inline_qos, const Bytes& payload);
  void keep(Message);

  const Participant& participant_;
  const Entity writer_;
  const Bytes good_;
  const Bytes of_another_type_;
  std::int64_t number_ = 0;
  std::vector<Message> sent_;
};

}  // namespace roci::services::contract::hostile
