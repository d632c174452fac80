// This file turns a generated struct of idl/ into bytes and back, and into the description that a transport
// needs. It needs Fast CDR alone.
//
// The bytes are a 4-byte encapsulation header and plain CDR in this machine's byte order; both byte orders
// are read. Equal values give equal bytes (padding is zero), so that samples can be hashed and compared.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

#include "services/transport/transport.hpp"

namespace roci::services::transport {

inline constexpr std::size_t kEncapsulationSize = 4;

namespace detail {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

inline FastBuffer read_only_buffer(std::span<const std::uint8_t> bytes) {
  return {const_cast<char*>(reinterpret_cast<const char*>(bytes.data())), bytes.size()};
}

/// Appends the CDR of the key members; `bound` is at least its size.
template <class T>
void append_key(const T& value, std::size_t bound, Cdr::Endianness order, Payload& out) {
  const std::size_t start = out.size();
  out.resize(start + bound);
  FastBuffer buffer(reinterpret_cast<char*>(out.data() + start), bound);
  Cdr cdr(buffer, order, Cdr::CORBA_CDR);
  value.serializeKey(cdr);
  out.resize(start + cdr.getSerializedDataLength());
}

/// Reads as much as is there. Returns false when the payload ends early or makes no sense.
template <class T>
bool read_prefix(std::span<const std::uint8_t> payload, T& value, Cdr::Endianness& order) {
  try {
    auto buffer = read_only_buffer(payload);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    order = cdr.endianness();
    value.deserialize(cdr);
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  } catch (const std::exception&) {
    return false;
  }
}

template <class T>
bool serialized_key(std::span<const std::uint8_t> payload, bool key_only, Payload& out) {
  if (payload.size() < kEncapsulationSize) return false;
  T value;
  auto order = Cdr::DEFAULT_ENDIAN;
  const bool whole = read_prefix(payload, value, order);
  if (!whole && !key_only) return false;
  const std::size_t bound = T::getCdrSerializedSize(value);
  if (!whole) {
    // The key members come first, so a key-only payload holds exactly the bytes that they serialize to.
    Payload prefix;
    append_key(value, bound, order, prefix);
    const auto body = payload.subspan(kEncapsulationSize);
    if (prefix.size() > body.size() || !std::equal(prefix.begin(), prefix.end(), body.begin())) return false;
  }
  append_key(value, bound, Cdr::BIG_ENDIANNESS, out);
  return true;
}

}  // namespace detail

/// Describes a type; `type_name` is the IDL name, e.g. "roci::v1::Goal". The struct's @key members must come
/// first in it.
template <class T>
TypeDescription describe_type(std::string type_name) {
  TypeDescription description{std::move(type_name), T::isKeyDefined(),
                              T::getKeyMaxCdrSerializedSize() <= sizeof(Guid), nullptr};
  if (description.keyed) description.serialized_key = &detail::serialized_key<T>;
  return description;
}

/// Returns a value as a payload.
template <class T>
Payload serialize(const T& value) {
  Payload payload(kEncapsulationSize + T::getCdrSerializedSize(value));
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data()), payload.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  value.serialize(cdr);
  payload.resize(cdr.getSerializedDataLength());
  return payload;
}

/// Returns false if the payload is not a whole T; `value` then holds whatever came before the damage.
template <class T>
[[nodiscard]] bool deserialize(std::span<const std::uint8_t> payload, T& value) {
  auto order = eprosima::fastcdr::Cdr::DEFAULT_ENDIAN;
  return detail::read_prefix(payload, value, order);
}

/// Fills in the key members from a whole or key-only payload (SampleKind::disposed, no_writers); the other
/// members are unspecified. Returns false if not even the key can be read.
template <class T>
[[nodiscard]] bool deserialize_key(std::span<const std::uint8_t> payload, T& value) {
  Payload key;
  if (!detail::serialized_key<T>(payload, true, key)) return false;
  auto order = eprosima::fastcdr::Cdr::DEFAULT_ENDIAN;
  detail::read_prefix(payload, value, order);
  return true;
}

}  // namespace roci::services::transport
