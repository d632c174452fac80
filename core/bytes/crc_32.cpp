#include "core/bytes/crc_32.hpp"

#include <array>
#include <cstddef>

namespace roci::bytes {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0xedb88320U;

// What is left of each byte after eight steps of the division (Sarwate, CACM 31(8), 1988).
constexpr std::array<std::uint32_t, 256> kRemainders = [] {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t byte = 0; byte < out.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit)
      rest = (rest & 1U) != 0 ? kReflectedPolynomial ^ (rest >> 1U) : rest >> 1U;
    out[byte] = rest;
  }
  return out;
}();

}  // namespace

Crc32& Crc32::add(std::string_view bytes) {
  for (const char c : bytes)
    remainder_ = kRemainders[(remainder_ ^ static_cast<unsigned char>(c)) & 0xffU] ^ (remainder_ >> 8U);
  return *this;
}

std::uint32_t crc_32(std::string_view bytes) { return Crc32().add(bytes).value(); }

}  // namespace roci::bytes
