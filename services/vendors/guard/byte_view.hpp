// This file reads numbers in a datagram, in the byte order that it declares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace roci::services::vendors::guard {

/// Views bytes with their byte order. The caller must have checked that what it reads lies within `bytes`.
struct ByteView {
  std::span<const std::uint8_t> bytes;
  bool little_endian = true;

  std::size_t size() const { return bytes.size(); }
  ByteView from(std::size_t at) const { return {bytes.subspan(at), little_endian}; }
  ByteView part(std::size_t at, std::size_t length) const {
    return {bytes.subspan(at, length), little_endian};
  }

  std::uint16_t u16(std::size_t at) const {
    const std::uint16_t first = bytes[at], second = bytes[at + 1];
    return static_cast<std::uint16_t>(little_endian ? first | second << 8 : first << 8 | second);
  }
  std::uint32_t u32(std::size_t at) const {
    const std::uint32_t first = u16(at), second = u16(at + 2);
    return little_endian ? first | second << 16 : first << 16 | second;
  }
  /// Reads an entity id in the order of its bytes, whatever theirs is (RTPS 2.3, 9.3.1.2).
  std::uint32_t entity_id(std::size_t at) const { return ByteView{bytes.subspan(at, 4), false}.u32(0); }
  /// Reads a sequence number, whose high half comes first in either byte order (RTPS 2.3, 9.3.2).
  std::int64_t sequence_number(std::size_t at) const {
    return static_cast<std::int64_t>(std::uint64_t{u32(at)} << 32 | u32(at + 4));
  }
};

}  // namespace roci::services::vendors::guard
