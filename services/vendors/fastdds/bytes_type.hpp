// This is a Fast DDS type whose samples are serialized already: it carries the bytes of any type of ours.
#pragma once

#include <array>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <optional>
#include <span>

#include "services/transport/transport.hpp"
#include "services/vendors/key_slots.hpp"

namespace roci::services::vendors::fastdds {

using KeyHash = KeySlots::KeyHash;

/// Holds what the vendor's `void* data` points to. A writer lends the bytes, a reader's sample owns them.
struct Bytes {
  std::span<const std::uint8_t> view;
  transport::Payload owned;
  std::optional<KeyHash> key_hash;  ///< if known already; the vendor asks for it up to three times per write
};

/// Returns the key hash of a whole or key-only payload: the big-endian key, or its MD5 where a key of the
/// type may be longer than the hash. Returns nothing if the payload is malformed.
std::optional<KeyHash> key_hash_of(const transport::TypeDescription&, std::span<const std::uint8_t> payload,
                                   bool force_md5);

/// Tells Fast DDS how to copy samples and find their keys.
class BytesType : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// Received samples that bring no key hash are given slots; without these, their key hashes.
  BytesType(const transport::TypeDescription&, std::shared_ptr<KeySlots>);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t*) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t*, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  /// Never fails for a keyed type, since the history of a reader aborts over a sample that has no instance: a sample
  /// whose key cannot be read is an instance by itself, of all its bytes, which the reader refuses.
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t*, bool force_md5) override;

 private:
  const transport::TypeDescription type_;
  const std::shared_ptr<KeySlots> slots_;
};

}  // namespace roci::services::vendors::fastdds
