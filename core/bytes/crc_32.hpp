// The CRC-32 tells whether bytes have changed on their way: it finds every burst of up to 32 wrong bits.
#pragma once

#include <cstdint>
#include <string_view>

namespace roci::bytes {

/// Computes the CRC-32 of IEEE 802.3 (polynomial 0x04C11DB7, reflected, inverted at both ends), which zlib and
/// PNG use, too, over bytes that are given piece by piece.
class Crc32 {
 public:
  Crc32& add(std::string_view bytes);
  /// Returns the checksum of all bytes so far; 0 without any.
  std::uint32_t value() const { return ~remainder_; }

 private:
  std::uint32_t remainder_ = ~std::uint32_t{0};
};

/// Returns the CRC-32 of bytes that are there as a whole.
std::uint32_t crc_32(std::string_view bytes);

}  // namespace roci::bytes
