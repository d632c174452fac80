// The instances of a keyed topic that are alive at one reader, and who writes them. Every vendor reports the
// end of an instance in its own way, and some without its key; readers ask this table, so that all of them
// report alike.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// 4-byte big-endian encapsulation header and the serialized key.
transport::Payload key_only_payload(std::span<const std::uint8_t> serialized_key);

class InstanceTable {
 public:
  using Key = std::string;  ///< whatever identifies the instance at the vendor: its key or the hash of it

  /// Notes that `writer` wrote the instance. False: the instance is new and must be introduced.
  bool wrote(const Key&, const transport::Guid& writer);
  /// With kInstances alive a new one is not entered: its samples are read, and its end is not told.
  void introduce(const Key&, const transport::Guid& writer, transport::Payload key_payload);

  /// So many instances of a topic are followed: every goal, timeline and step that the parts above
  /// keep, several times over.
  static constexpr std::size_t kInstances = 65'536;
  /// So many writers of one instance are: a pair of executives, and their earlier starts.
  static constexpr std::size_t kWriters = 256;

  /// The instance was disposed or lost its last writer: its key-only payload; nothing if it was not alive
  /// here.
  std::optional<transport::Payload> ended(const Key&);

  /// Key-only payloads of the instances that nobody writes any more, now that `writer` has gone.
  std::vector<transport::Payload> writer_left(const transport::Guid& writer);

 private:
  struct Instance {
    transport::Payload key_payload;
    std::vector<transport::Guid> writers;
  };

  std::unordered_map<Key, Instance> alive_;
};

}  // namespace roci::services::vendors
