#include "services/vendors/guard/data.hpp"

#include <algorithm>
#include <cstdint>

#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {
namespace {

// Bytes of DATA and DATA_FRAG up to the inline QoS.
constexpr std::size_t kFixedOfData = 20, kFixedOfFragment = 32;

bool is_of_user(const ByteView& entity_id) { return (entity_id.bytes[3] & 0xc0) != 0xc0; }

// What each GUID-keyed writer of discovery and liveliness tells of (RTPS 2.3, 9.3.1.3; DDS Security 1.1, 7.3.7.1).
enum class WriterKind { user, discovery, liveliness, other_builtin };

WriterKind kind_of_writer(const ByteView& entity_id) {
  if (is_of_user(entity_id)) return WriterKind::user;
  switch (entity_id.entity_id(0)) {
    case kParticipants:
    case kTopics:
    case kWriters:
    case kReaders:
    case kSecureParticipants:
    case kSecureWriters:
    case kSecureReaders:
      return WriterKind::discovery;
    case kLiveliness:
    case kSecureLiveliness:
      return WriterKind::liveliness;
    default:
      return WriterKind::other_builtin;
  }
}

struct Parts {
  DatagramAdmission admission = DatagramAdmission::pass;
  WriterKind writer = WriterKind::user;
  ByteView payload{};
};

// What DATA and DATA_FRAG have in common: extra flags, offset of the inline QoS, reader, writer, sequence number.
// `fixed` is the size of the fixed part.
Parts split(const Submessage& message, std::size_t fixed, const GuidPrefix& sender) {
  const ByteView& body = message.body;
  if (body.size() < fixed) return {DatagramAdmission::cut};
  const std::size_t offset = body.u16(2);  // counted from behind itself
  if (offset % 4 != 0 || offset < fixed - 4 || offset > body.size() - 4) return {DatagramAdmission::cut};
  if (!is_number(body.sequence_number(12))) return {DatagramAdmission::bad_numbers};
  Parts parts{DatagramAdmission::pass, kind_of_writer(body.part(8, 4)), body.from(4 + offset)};
  const bool inline_qos = (message.flags & kInlineQosFlag) != 0;
  if (!inline_qos) return parts;
  const bool guarded = parts.writer == WriterKind::discovery || parts.writer == WriterKind::liveliness;
  const auto list =
      examine_parameters(parts.payload, ListKind::inline_qos, guarded ? std::optional(sender) : std::nullopt);
  if (list.admission != DatagramAdmission::pass) return {list.admission};
  parts.payload = parts.payload.from(list.size);
  return parts;
}

// A parameter list behind its encapsulation header. A participant says how long its lease is: what vendors take for a
// default lasts for ever. A bare key of 16 bytes would be taken for the GUID that it holds.
DatagramAdmission discovery_payload(const ByteView& payload, const GuidPrefix& sender, bool has_lease) {
  if (payload.size() > kMaxDiscoveryBytes) return DatagramAdmission::oversized;
  const bool big = payload.bytes[1] == 2, little = payload.bytes[1] == 3;
  if (payload.bytes[0] != 0 || (!big && !little)) return DatagramAdmission::bad_parameters;
  const ByteView list{payload.bytes.subspan(4), little};
  const auto judged = examine_parameters(list, ListKind::discovery, sender);
  if (judged.admission != DatagramAdmission::pass) return judged.admission;
  if (has_lease && !find_parameter(list, kLease)) return DatagramAdmission::bad_parameters;
  return payload.size() > 16 ? DatagramAdmission::pass : DatagramAdmission::bad_parameters;
}

// ParticipantMessageData begins with the prefix of the participant that it says is alive.
DatagramAdmission liveliness_payload(const ByteView& payload, const GuidPrefix& sender) {
  if (payload.size() < 4 + sender.size()) return DatagramAdmission::bad_parameters;
  return may_speak_for(sender, payload.bytes.subspan(4)) ? DatagramAdmission::pass
                                                         : DatagramAdmission::speaks_for_another;
}

}  // namespace

bool is_of_user(const Submessage& message) { return is_of_user(message.body.part(8, 4)); }

ByteView payload_of(const Submessage& message) {
  const std::size_t fixed = message.id == kData ? kFixedOfData : kFixedOfFragment;
  const ByteView& body = message.body;
  if (body.size() < fixed) return {};
  const std::size_t offset = 4 + std::size_t{body.u16(2)};
  if (offset < fixed || offset > body.size()) return {};
  ByteView rest = body.from(offset);
  const bool inline_qos = (message.flags & kInlineQosFlag) != 0;
  if (inline_qos) {
    const auto list = examine_parameters(rest, ListKind::inline_qos, std::nullopt);
    if (list.admission != DatagramAdmission::pass) return {};
    rest = rest.from(list.size);
  }
  if (rest.size() < 4) return {};
  const bool little = (rest.bytes[1] & 1) != 0;
  return {rest.bytes.subspan(4), little};
}

DatagramAdmission examine_data(const Submessage& message, const GuidPrefix& sender) {
  const bool data = (message.flags & kDataFlag) != 0, key = (message.flags & kKeyFlag) != 0;
  if (data && key) return DatagramAdmission::cut;
  const Parts parts = split(message, kFixedOfData, sender);
  if (parts.admission != DatagramAdmission::pass) return parts.admission;
  if (!data && !key) return DatagramAdmission::pass;
  if (parts.payload.size() < 4) return DatagramAdmission::cut;
  if (parts.writer == WriterKind::discovery) {
    const bool has_lease = data && message.body.entity_id(8) == kParticipants;
    return discovery_payload(parts.payload, sender, has_lease);
  }
  if (parts.writer == WriterKind::liveliness) return liveliness_payload(parts.payload, sender);
  return DatagramAdmission::pass;
}

DatagramAdmission examine_data_fragment(const Submessage& message, const GuidPrefix& sender) {
  const Parts parts = split(message, kFixedOfFragment, sender);
  if (parts.admission != DatagramAdmission::pass) return parts.admission;
  // Discovery fits into one datagram; in pieces it could not be judged.
  if (parts.writer == WriterKind::discovery || parts.writer == WriterKind::liveliness)
    return DatagramAdmission::bad_fragment;
  const ByteView& body = message.body;
  const std::uint64_t first = body.u32(20), count = body.u16(24), size = body.u16(26), sample = body.u32(28);
  if (first == 0 || count == 0 || size == 0 || sample == 0) return DatagramAdmission::bad_fragment;
  if (sample > kMaxSampleBytes) return DatagramAdmission::oversized;
  const std::uint64_t begin = (first - 1) * size;
  if (begin + (count - 1) * size >= sample) return DatagramAdmission::bad_fragment;
  return parts.payload.size() < std::min(count * size, sample - begin) ? DatagramAdmission::bad_fragment
                                                                       : DatagramAdmission::pass;
}

}  // namespace roci::services::vendors::guard
