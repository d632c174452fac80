#include "services/vendors/guard/endpoints.hpp"

#include <algorithm>
#include <optional>

#include "services/vendors/guard/data.hpp"
#include "services/vendors/guard/message.hpp"
#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {

std::vector<EndpointWord> endpoints_in(std::span<const std::uint8_t> message) {
  std::vector<EndpointWord> out;
  for_each_submessage(message, [&out](const Submessage& one) {
    if (one.id != kData) return;
    const std::uint32_t writer = one.body.entity_id(8);
    if (writer != kWriters && writer != kReaders && writer != kTopics) return;
    EndpointWord word{{}, writer, one.body.sequence_number(12), false};
    std::optional<ByteView> named;
    if ((one.flags & kInlineQosFlag) != 0) {
      const ByteView inline_qos = one.body.from(4 + std::size_t{one.body.u16(2)});
      named = find_parameter(inline_qos, kKeyHash);
      const auto status = find_parameter(inline_qos, kStatusInfo);
      word.ended = status && (status->bytes[3] & kNotAlive) != 0;
    }
    const ByteView payload = (one.flags & (kDataFlag | kKeyFlag)) != 0 ? payload_of(one) : ByteView{};
    if (payload.size() > 0) {
      const auto said = find_parameter(payload, kEndpointGuid);
      if (said) named = said;
    }
    if (!named) return;
    std::ranges::copy(named->bytes, word.guid.begin());
    out.push_back(word);
  });
  return out;
}

void limit_leases(std::span<std::uint8_t> message) {
  for_each_submessage(message, [message](const Submessage& one) {
    if (one.id != kData || (one.flags & kDataFlag) == 0 || one.body.entity_id(8) != kParticipants) return;
    for_each_parameter(payload_of(one), kLease, [message](const ByteView& lease) {
      if (lease.u32(0) < kLongestLease) return;
      const auto value = message.subspan(static_cast<std::size_t>(lease.bytes.data() - message.data()), 8);
      std::ranges::fill(value, std::uint8_t{0});
      value[lease.little_endian ? 0 : 3] = kLongestLease;
    });
  });
}

}  // namespace roci::services::vendors::guard
