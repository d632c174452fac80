#include "arm_svc/fingerprint.hpp"

#include <bit>

namespace roci::arm {

Fingerprint& Fingerprint::add(std::string_view text) {
  hash_.add(text);
  return add(static_cast<std::uint64_t>(text.size()));
}

Fingerprint& Fingerprint::add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }

Fingerprint& Fingerprint::add(std::uint64_t value) {
  hash_.add_number(value);
  return *this;
}

}  // namespace roci::arm
