#include "services/vendors/guard/discovery.hpp"

#include <algorithm>
#include <string_view>

#include "services/vendors/guard/data.hpp"
#include "services/vendors/guard/message.hpp"
#include "services/vendors/guard/rtps_ids.hpp"
#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {
namespace {

// Calls `see` with the payload of each sample of this writer.
template <class See>
void for_each_sample(std::span<const std::uint8_t> message, std::uint32_t writer, See see) {
  for_each_submessage(message, [&](const Submessage& one) {
    if (!is_data(one) || one.body.size() < 12) return;
    if (one.body.entity_id(8) != writer) return;
    const ByteView payload = payload_of(one);
    if (payload.size() > 0) see(payload);
  });
}

bool has(const ByteView& payload, std::string_view text) {
  return std::search(payload.bytes.begin(), payload.bytes.end(), text.begin(), text.end()) !=
         payload.bytes.end();
}

std::optional<Source> udp4(const ByteView& locator) {
  if (locator.size() != 24 || locator.u32(0) != kUdp4 || locator.u32(4) > 0xffff) return std::nullopt;
  const ByteView address{locator.part(20, 4).bytes, false};
  return Source{address.u32(0), static_cast<std::uint16_t>(locator.u32(4))};
}

}  // namespace

std::optional<Announcement> announcement_in(std::span<const std::uint8_t> message) {
  Announcement out{sender_of(message), {}};
  for_each_sample(message, kParticipants, [&](const ByteView& list) {
    for (std::size_t at = 0; at + 4 <= list.size();) {
      const std::uint16_t id = list.u16(at);
      const std::size_t length = list.u16(at + 2);
      at += 4;
      if (id == kSentinel || length > list.size() - at) return;
      if (id == kDefaultUnicastLocator || id == kMetatrafficUnicastLocator)
        if (const auto reached = udp4(list.part(at, length))) out.reached_at.push_back(*reached);
      at += length;
    }
  });
  return out.reached_at.empty() ? std::nullopt : std::optional(std::move(out));
}

// ParticipantGenericMessage: two message identities of 24 bytes, then the participant for whom it is.
std::vector<HandshakePart> handshakes_in(std::span<const std::uint8_t> message) {
  constexpr std::size_t kDestination = 48;
  std::vector<HandshakePart> out;
  for_each_sample(message, kHandshakes, [&](const ByteView& payload) {
    HandshakePart part;
    if (payload.size() < kDestination + part.with.size()) return;
    std::copy_n(payload.bytes.begin() + kDestination, part.with.size(), part.with.begin());
    part.begins = !has(payload, "DDS:Auth:PKI-DH:1.0+Reply") && !has(payload, "DDS:Auth:PKI-DH:1.0+Final");
    // A later fragment, whose beginning is anything.
    if (part.begins && !has(payload, "DDS:Auth:PKI-DH:1.0+Req") &&
        !has(payload, "DDS:Auth:PKI-DH:1.0+AuthReq"))
      return;
    out.push_back(part);
  });
  return out;
}

}  // namespace roci::services::vendors::guard
