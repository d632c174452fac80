#include "services/vendors/fastdds/bytes_type.hpp"

#include <algorithm>

namespace roci::services::vendors::fastdds {

using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

namespace {

// First allocation of a sample; the history grows it when a sample is larger.
constexpr std::uint32_t kInitialSize = 512;

KeyHash md5_of(std::span<const std::uint8_t> bytes) {
  MD5 md5;
  md5.init();
  md5.update(bytes.data(), static_cast<MD5::size_type>(bytes.size()));
  md5.finalize();
  KeyHash hash;
  std::copy(std::begin(md5.digest), std::end(md5.digest), hash.begin());
  return hash;
}

}  // namespace

std::optional<KeyHash> key_hash_of(const transport::TypeDescription& type,
                                   std::span<const std::uint8_t> payload, bool force_md5) {
  transport::Payload key;
  if (!type.serialized_key(payload, true, key)) return std::nullopt;
  if (!type.key_fits_hash || force_md5) return md5_of(key);
  KeyHash hash{};
  std::copy(key.begin(), key.end(), hash.begin());
  return hash;
}

BytesType::BytesType(const transport::TypeDescription& type, std::shared_ptr<KeySlots> slots)
    : type_(type), slots_(std::move(slots)) {
  setName(type.name.c_str());
  m_typeSize = kInitialSize;
  m_isGetKeyDefined = type.keyed;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool BytesType::serialize(void* data, SerializedPayload_t* payload) {
  const auto& bytes = static_cast<const Bytes*>(data)->view;
  if (bytes.size() < 4 || bytes.size() > payload->max_size) return false;
  payload->encapsulation = bytes[1];
  std::copy(bytes.begin(), bytes.end(), payload->data);
  payload->length = static_cast<std::uint32_t>(bytes.size());
  return true;
}

bool BytesType::deserialize(SerializedPayload_t* payload, void* data) {
  auto& bytes = *static_cast<Bytes*>(data);
  bytes.owned.assign(payload->data, payload->data + payload->length);
  bytes.view = bytes.owned;
  return true;
}

std::function<std::uint32_t()> BytesType::getSerializedSizeProvider(void* data) {
  const auto size = static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->view.size());
  return [size] { return size; };
}

void* BytesType::createData() { return new Bytes; }

void BytesType::deleteData(void* data) { delete static_cast<Bytes*>(data); }

bool BytesType::getKey(void* data, InstanceHandle_t* handle, bool force_md5) {
  const auto& bytes = *static_cast<const Bytes*>(data);
  if (!type_.keyed) return false;
  const auto known =
      bytes.key_hash && !force_md5 ? bytes.key_hash : key_hash_of(type_, bytes.view, force_md5);
  const KeyHash hash = known ? *known : md5_of(bytes.view);
  const bool received = !bytes.key_hash;
  const KeySlots::Handle seen = received && slots_ ? slots_->handle_of(hash) : hash;
  for (std::size_t i = 0; i < seen.size(); ++i) handle->value[i] = seen[i];
  return true;
}

}  // namespace roci::services::vendors::fastdds
