// The instance table has the instances of a keyed topic that are alive at one reader, and their writers.
// Every vendor reports the end of an instance in its own way, some without its key; readers ask this table,
// so that all of them report alike.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// Returns a 4-byte big-endian encapsulation header and the serialized key.
transport::Payload key_only_payload(std::span<const std::uint8_t> serialized_key);

/// Tells when an instance has ended, and its key.
class InstanceTable {
 public:
  using Key = std::string;  ///< whatever identifies the instance at the vendor: its key or the hash of it

  /// Notes that `writer` wrote the instance. Returns false if the instance is new and must be introduced.
  bool wrote(const Key&, const transport::Guid& writer);
  /// Enters a new instance and returns true. With kInstances alive it is not entered: its samples are read, but its end
  /// is not reported.
  bool introduce(const Key&, const transport::Guid& writer, transport::Payload key_payload);

  /// Bounds the instances of a topic that are followed: several times every goal, timeline and step that the
  /// parts above keep.
  static constexpr std::size_t kInstances = 65'536;
  /// Bounds the writers of one instance that are followed: a pair of executives, and their earlier starts.
  static constexpr std::size_t kWriters = 256;

  /// Takes in that the instance was disposed or lost its last writer, and returns its key-only payload, or
  /// nothing if it was not alive here.
  std::optional<transport::Payload> ended(const Key&);

  struct Orphan {
    Key key;
    transport::Payload key_payload;
  };
  /// Returns the instances that nobody writes any more, now that `writer` has gone.
  std::vector<Orphan> writer_left(const transport::Guid& writer);

  /// Returns the keys of all instances that are alive.
  std::vector<Key> keys() const;

 private:
  struct Instance {
    transport::Payload key_payload;
    std::vector<transport::Guid> writers;
  };

  std::unordered_map<Key, Instance> alive_;
};

}  // namespace roci::services::vendors
