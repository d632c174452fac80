#include "services/certificate/guid_prefix.hpp"

#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace roci::services::certificate {
namespace {

using Hash = std::array<std::uint8_t, SHA256_DIGEST_LENGTH>;

Hash sha256(std::span<const std::uint8_t> bytes) {
  Hash hash;
  SHA256(bytes.data(), bytes.size(), hash.data());
  return hash;
}

constexpr std::string_view kConsole = "roci";

// What strangers write as their name is looked up, too: only so many are remembered.
constexpr std::size_t kRemembered = 1024;

struct Memory {
  std::mutex mutex;
  std::map<std::string, std::vector<Start>, std::less<>> starts;
};
Memory& memory() {
  static auto* const kept = new Memory;  // vendors' threads may outlive main()
  return *kept;
}

std::vector<Start> starts_of(std::string_view service) {
  auto& known = memory();
  const std::lock_guard lock(known.mutex);
  if (const auto found = known.starts.find(service); found != known.starts.end()) return found->second;
  std::vector<Start> starts;
  for (const std::string_view vendor : kVendors) starts.push_back(start_of(subject_of(service, vendor)));
  if (known.starts.size() < kRemembered) known.starts.emplace(service, starts);
  return starts;
}

bool begins_with(const transport::Guid& guid, const Start& start) {
  return std::equal(start.begin(), start.end(), guid.begin());
}

}  // namespace

Start start_of(const Subject& subject) {
  const Hash hash = sha256(subject.der());
  Start start;
  std::uint8_t before = 0x80;
  for (std::size_t i = 0; i < start.size(); ++i) {
    start[i] = static_cast<std::uint8_t>(before | hash[i] >> 1);
    before = static_cast<std::uint8_t>(hash[i] << 7);
  }
  return start;
}

Prefix candidate_naming(std::uint16_t port, Hashed hashed) {
  std::array<std::uint8_t, 16> guid{};
  if (RAND_bytes(guid.data(), 12) != 1) throw std::runtime_error("OpenSSL has no random numbers");
  constexpr std::array<std::uint8_t, 4> kParticipant{0x00, 0x00, 0x01, 0xc1};
  std::copy(kParticipant.begin(), kParticipant.end(), guid.begin() + 12);
  const std::span<const std::uint8_t> bytes(guid.data(), hashed == Hashed::prefix ? 12 : 16);
  for (std::uint32_t number = 0;; ++number) {
    for (std::size_t i = 0; i < 4; ++i) guid[8 + i] = static_cast<std::uint8_t>(number >> 8 * i);
    const Hash hash = sha256(bytes);
    if (hash[0] == port >> 8 && hash[1] == (port & 0xff)) break;
  }
  Prefix prefix;
  std::copy_n(guid.begin(), prefix.size(), prefix.begin());
  return prefix;
}

std::string_view service_of(std::string_view sender) {
  for (const std::string_view member : {".first", ".second"})
    if (sender.ends_with(member)) return sender.substr(0, sender.size() - member.size());
  const bool console = sender.starts_with(kConsole) && sender.substr(kConsole.size()).starts_with("-");
  return console ? kConsole : sender;
}

bool speaks_as(const transport::Guid& guid, std::string_view sender) {
  try {
    return std::ranges::any_of(starts_of(service_of(sender)),
                               [&](const Start& start) { return begins_with(guid, start); });
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void require_certified(const transport::Guid& guid, std::string_view service, std::string_view vendor) {
  if (begins_with(guid, start_of(subject_of(service, vendor)))) return;
  throw transport::TransportError(
      "this run is secure, but " + std::string(vendor) +
      " has not made its participant from the certificate of " + std::string(service) +
      "; its library may have been built without DDS Security: use that of Debian 12");
}

}  // namespace roci::services::certificate
