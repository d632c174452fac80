// Whole numbers stand in files and messages with their lowest byte first, whatever the machine's own order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace roci::bytes {

/// Appends the lowest `size` bytes of a number, 8 at most.
constexpr void append_little_endian(std::string& out, std::uint64_t number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) out += static_cast<char>(number >> (8 * i));
}

/// Returns the number that all these bytes are, 8 at most.
constexpr std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t out = 0;
  for (std::size_t i = bytes.size(); i > 0; --i) out = out << 8U | static_cast<unsigned char>(bytes[i - 1]);
  return out;
}

}  // namespace roci::bytes
