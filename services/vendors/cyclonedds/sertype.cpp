#include "services/vendors/cyclonedds/sertype.hpp"

extern "C" {
#include <dds/ddsi/q_radmin.h>
#include <dds/ddsrt/heap.h>
#include <dds/ddsrt/md5.h>
#include <dds/ddsrt/mh3.h>
}

#include <algorithm>
#include <cstring>
#include <memory>

#include "services/vendors/history_limits.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

const Serdata& own(const ddsi_serdata* data) { return *static_cast<const Serdata*>(data); }
const Sertype& own(const ddsi_sertype* type) { return *static_cast<const Sertype*>(type); }

ddsi_keyhash_t md5_of(std::span<const std::uint8_t> bytes) {
  ddsi_keyhash_t hash;
  ddsrt_md5_state_t state;
  ddsrt_md5_init(&state);
  ddsrt_md5_append(&state, bytes.data(), static_cast<unsigned>(bytes.size()));
  ddsrt_md5_finish(&state, hash.value);
  return hash;
}

ddsi_keyhash_t hash_of_key(const transport::TypeDescription& type, std::span<const std::uint8_t> key) {
  if (!type.key_fits_hash) return md5_of(key);
  ddsi_keyhash_t hash{};
  std::copy(key.begin(), key.end(), hash.value);
  return hash;
}

std::unique_ptr<Serdata> empty_serdata(const Sertype& type, ddsi_serdata_kind kind) {
  auto data = std::make_unique<Serdata>();
  ddsi_serdata_init(data.get(), &type, kind);
  return data;
}

void set_key_hash(Serdata& data, const ddsi_keyhash_t& hash) {
  data.key_hash = hash;
  data.hash = ddsrt_mh3(hash.value, sizeof hash.value, 0) ^ data.type->serdata_basehash;
}

std::atomic<std::uint64_t> refused_for_keys = 0;

LiveKeys::Key key_of(const ddsi_keyhash_t& hash) {
  LiveKeys::Key key;
  std::copy(std::begin(hash.value), std::end(hash.value), key.begin());
  return key;
}

// A received sample, or null if nobody has room for its key. The vendor takes it for malformed then, and confirms it.
Serdata* received(const Sertype& type, Serdata* data) {
  if (data == nullptr || !type.type.keyed || type.keys->admits(key_of(data->key_hash))) return data;
  ++refused_for_keys;
  ddsi_serdata_unref(data);
  return nullptr;
}

// The bytes must stand in `bytes` already.
Serdata* finish(const Sertype& type, std::unique_ptr<Serdata> data) {
  transport::Payload key;
  if (data->size < 4) return nullptr;
  if (type.type.keyed) {
    const bool key_only = data->kind == SDK_KEY;
    if (!type.type.serialized_key(data->payload(), key_only, key)) return nullptr;
    if (key_only) {
      data->bytes = key_only_payload(key);
      data->size = data->bytes.size();
      data->bytes.resize((data->size + 3) / 4 * 4);
    }
  }
  set_key_hash(*data, type.type.keyed ? hash_of_key(type.type, key) : ddsi_keyhash_t{});
  return data.release();
}

void reserve(Serdata& data, std::size_t size) {
  data.bytes.resize((size + 3) / 4 * 4);
  data.size = size;
}

// --- serdata operations, called by Cyclone DDS ---

bool eqkey(const ddsi_serdata* a, const ddsi_serdata* b) {
  return std::memcmp(own(a).key_hash.value, own(b).key_hash.value, sizeof(ddsi_keyhash_t)) == 0;
}

std::uint32_t get_size(const ddsi_serdata* data) { return static_cast<std::uint32_t>(own(data).size); }

ddsi_serdata* from_ser(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                       std::size_t size) {
  auto data = empty_serdata(own(type), kind);
  reserve(*data, size);
  std::size_t filled = 0;  // fragments are ordered, may overlap, and leave no gap
  for (; fragment; fragment = fragment->nextfrag) {
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    if (end <= filled) continue;
    const unsigned char* bytes = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::copy_n(bytes + (filled - fragment->min), end - filled,
                data->bytes.begin() + static_cast<long>(filled));
    filled = end;
  }
  return received(own(type), finish(own(type), std::move(data)));
}

ddsi_serdata* from_ser_iov(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                           const ddsrt_iovec_t* parts, std::size_t size) {
  auto data = empty_serdata(own(type), kind);
  reserve(*data, size);
  std::size_t filled = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && filled < size; ++i) {
    const std::size_t length = std::min<std::size_t>(parts[i].iov_len, size - filled);
    std::memcpy(data->bytes.data() + filled, parts[i].iov_base, length);
    filled += length;
  }
  return finish(own(type), std::move(data));
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash_t* hash) {
  auto data = empty_serdata(own(type), SDK_KEY);
  set_key_hash(*data, *hash);
  return received(own(type), data.release());
}

void to_ser(const ddsi_serdata* data, std::size_t offset, std::size_t size, void* out) {
  std::memcpy(out, own(data).bytes.data() + offset, size);
}

ddsi_serdata* to_ser_ref(const ddsi_serdata* data, std::size_t offset, std::size_t size, ddsrt_iovec_t* out) {
  out->iov_base = const_cast<std::uint8_t*>(own(data).bytes.data() + offset);
  out->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(data);
}

void to_ser_unref(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }

ddsi_serdata* to_untyped(const ddsi_serdata* data) {
  auto key = empty_serdata(own(data->type), SDK_KEY);
  set_key_hash(*key, own(data).key_hash);
  key->type = nullptr;
  key->kept_in = own(data->type).keys;
  key->kept_in->add(key_of(key->key_hash));
  return key.release();
}

void get_keyhash(const ddsi_serdata* data, ddsi_keyhash_t* out, bool force_md5) {
  const auto& sample = own(data);
  *out = sample.key_hash;
  if (!force_md5 || !sample.type || !own(sample.type).type.key_fits_hash) return;
  transport::Payload key;
  if (own(sample.type).type.serialized_key(sample.payload(), true, key)) *out = md5_of(key);
}

void free_serdata(ddsi_serdata* data) {
  if (own(data).kept_in) own(data).kept_in->remove(key_of(own(data).key_hash));
  delete static_cast<Serdata*>(data);
}

std::size_t print(const ddsi_sertype*, const ddsi_serdata*, char* out, std::size_t size) {
  if (size > 0) out[0] = 0;
  return 0;
}

// Samples as C structs do not exist here: only dds_writecdr, dds_forwardcdr and dds_takecdr are used.
ddsi_serdata* from_sample(const ddsi_sertype*, ddsi_serdata_kind, const void*) { return nullptr; }
bool to_sample(const ddsi_serdata*, void*, void**, void*) { return false; }
bool untyped_to_sample(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return false; }

// --- sertype operations ---

void free_sertype(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<Sertype*>(type);
}

bool equal(const ddsi_sertype* a, const ddsi_sertype* b) {
  const auto& left = own(a).type;
  const auto& right = own(b).type;
  return left.keyed == right.keyed && left.key_fits_hash == right.key_fits_hash &&
         left.serialized_key == right.serialized_key;
}

std::uint32_t hash(const ddsi_sertype*) { return 0; }
void zero_samples(const ddsi_sertype*, void*, std::size_t) {}
void realloc_samples(void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {}
void free_samples(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

constexpr ddsi_serdata_ops serdata_operations() {
  ddsi_serdata_ops ops{};
  ops.eqkey = eqkey;
  ops.get_size = get_size;
  ops.from_ser = from_ser;
  ops.from_ser_iov = from_ser_iov;
  ops.from_keyhash = from_keyhash;
  ops.from_sample = from_sample;
  ops.to_ser = to_ser;
  ops.to_ser_ref = to_ser_ref;
  ops.to_ser_unref = to_ser_unref;
  ops.to_sample = to_sample;
  ops.to_untyped = to_untyped;
  ops.untyped_to_sample = untyped_to_sample;
  ops.free = free_serdata;
  ops.print = print;
  ops.get_keyhash = get_keyhash;
  return ops;
}

ddsi_sertype_ops sertype_operations() {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = free_sertype;
  ops.zero_samples = zero_samples;
  ops.realloc_samples = realloc_samples;
  ops.free_samples = free_samples;
  ops.equal = equal;
  ops.hash = hash;
  return ops;
}

const ddsi_serdata_ops kSerdataOperations = serdata_operations();
const ddsi_sertype_ops kSertypeOperations = sertype_operations();

}  // namespace

void LiveKeys::add(const Key& key) {
  const std::lock_guard lock(mutex_);
  ++kept_[key];
  size_ = kept_.size();
}

void LiveKeys::remove(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(key);
  if (found != kept_.end() && --found->second == 0) kept_.erase(found);
  size_ = kept_.size();
}

bool LiveKeys::admits(const Key& key) const {
  if (size_ < kKeysOfTopic) return true;
  const std::lock_guard lock(mutex_);
  return kept_.contains(key);
}

std::uint64_t samples_of_too_many_keys() { return refused_for_keys; }

InstanceTable::Key Serdata::instance() const {
  return {reinterpret_cast<const char*>(key_hash.value), sizeof key_hash.value};
}

ddsi_sertype* make_sertype(const transport::TypeDescription& description) {
  auto type = std::make_unique<Sertype>();
  // Fast DDS readers depend on the key hash: a dispose without it would abort them.
  ddsi_sertype_init_flags(
      type.get(), description.name.c_str(), &kSertypeOperations, &kSerdataOperations,
      description.keyed ? DDSI_SERTYPE_FLAG_REQUEST_KEYHASH : DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  type->type = description;
  type->keys = std::make_shared<LiveKeys>();
  return type.release();
}

Serdata* make_serdata(const Sertype& type, ddsi_serdata_kind kind, std::span<const std::uint8_t> payload) {
  auto data = empty_serdata(type, kind);
  reserve(*data, payload.size());
  std::copy(payload.begin(), payload.end(), data->bytes.begin());
  return finish(type, std::move(data));
}

}  // namespace roci::services::vendors::cyclonedds
