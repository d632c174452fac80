#include "arm_svc/fingerprint.hpp"

#include <bit>

namespace roci::arm {
namespace {

constexpr std::uint64_t kPrime = 0x100000001b3;

}  // namespace

Fingerprint& Fingerprint::add(std::string_view text) {
  for (const char c : text) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
  return add(static_cast<std::uint64_t>(text.size()));
}

Fingerprint& Fingerprint::add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }

Fingerprint& Fingerprint::add(std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ ((value >> shift) & 0xff)) * kPrime;
  return *this;
}

}  // namespace roci::arm
