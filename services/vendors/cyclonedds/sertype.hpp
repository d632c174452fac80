// This is a Cyclone DDS type whose samples are serialized already: it carries the bytes of any type of ours.
// It stands on private headers of Cyclone DDS 0.10 (ddsi/), which is why CMake asks for exactly that series.
#pragma once

extern "C" {
#include <dds/dds.h>
#include <dds/ddsi/ddsi_keyhash.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
}

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "services/transport/transport.hpp"
#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors::cyclonedds {

/// Counts the keys of one type that the vendor keeps in this process, of its own samples and of received ones: it
/// makes a sample without type for each of them, and frees it with the instance. Any thread may call it.
class LiveKeys {
 public:
  using Key = std::array<std::uint8_t, 16>;  ///< key hash

  void add(const Key&);
  void remove(const Key&);
  /// Returns whether a received sample of this key may be read: there is room (kKeysOfTopic), or the key is
  /// kept already.
  bool admits(const Key&) const;

 private:
  mutable std::mutex mutex_;
  std::map<Key, int> kept_;
  std::atomic<std::size_t> size_ = 0;
};

/// Returns how many received samples of this process were refused for want of room for their keys.
std::uint64_t samples_of_too_many_keys();

/// Describes one of our types to the vendor.
struct Sertype : ddsi_sertype {
  transport::TypeDescription type;
  std::shared_ptr<LiveKeys> keys;
};

/// Holds one sample. It is immutable, and Cyclone DDS counts references to it, since it shares it between
/// writer history, readers and network.
struct Serdata : ddsi_serdata {
  transport::Payload bytes;  ///< zero-padded to a multiple of 4, as the network code reads it
  std::size_t size = 0;      ///< size of the payload in `bytes`; 0: only the key hash is known
  ddsi_keyhash_t key_hash{};
  std::shared_ptr<LiveKeys> kept_in{};  ///< set in a sample that stands for an instance

  std::span<const std::uint8_t> payload() const { return {bytes.data(), size}; }
  InstanceTable::Key instance() const;
};

/// Makes a type, which the caller owns until dds_create_topic_sertype takes it over.
ddsi_sertype* make_sertype(const transport::TypeDescription&);

/// Makes a whole sample, or the key of one (SDK_KEY). Returns null if the payload is malformed.
Serdata* make_serdata(const Sertype&, ddsi_serdata_kind, std::span<const std::uint8_t> payload);

}  // namespace roci::services::vendors::cyclonedds
