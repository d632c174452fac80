#include "services/vendors/guard/submessages.hpp"

#include "services/vendors/guard/data.hpp"
#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {
namespace {

constexpr std::uint32_t kMaxBits = 256;  // of a set of sequence or fragment numbers (RTPS 2.3, 9.4.2.6)

std::size_t bytes_of_bits(std::uint32_t bits) { return (bits + 31) / 32 * 4; }

DatagramAdmission at_least(const Submessage& message, std::size_t size) {
  return message.body.size() < size ? DatagramAdmission::cut : DatagramAdmission::pass;
}

DatagramAdmission acknack(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 24) return DatagramAdmission::cut;
  const std::int64_t base = body.sequence_number(8);
  const std::uint32_t bits = body.u32(16);
  const bool preemptive = base == 0 && bits == 0;  // Fast DDS sends these before it knows the writer
  if (bits > kMaxBits || (!is_number(base) && !preemptive)) return DatagramAdmission::bad_numbers;
  return at_least(message, 24 + bytes_of_bits(bits));
}

DatagramAdmission heartbeat(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return DatagramAdmission::cut;
  const std::int64_t first = body.sequence_number(8), last = body.sequence_number(16);
  const bool good = is_number(first) && last >= first - 1 && last <= kHighestNumber;
  return good ? DatagramAdmission::pass : DatagramAdmission::bad_numbers;
}

DatagramAdmission gap(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return DatagramAdmission::cut;
  const std::int64_t start = body.sequence_number(8), base = body.sequence_number(16);
  const std::uint32_t bits = body.u32(24);
  if (!is_number(start) || !is_number(base) || bits > kMaxBits) return DatagramAdmission::bad_numbers;
  return at_least(message, 28 + bytes_of_bits(bits));
}

// No sample has more fragments than it may have bytes.
bool is_fragment(std::uint32_t number) { return number > 0 && number <= kMaxSampleBytes; }

DatagramAdmission nack_fragments(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return DatagramAdmission::cut;
  const std::uint32_t base = body.u32(16), bits = body.u32(20);
  if (!is_number(body.sequence_number(8)) || !is_fragment(base) || bits > kMaxBits)
    return DatagramAdmission::bad_numbers;
  return at_least(message, 28 + bytes_of_bits(bits));
}

DatagramAdmission heartbeat_fragments(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 24) return DatagramAdmission::cut;
  const bool good = is_number(body.sequence_number(8)) && is_fragment(body.u32(16));
  return good ? DatagramAdmission::pass : DatagramAdmission::bad_numbers;
}

DatagramAdmission info_source(const Submessage& message, const GuidPrefix& sender) {
  if (message.body.size() < 20) return DatagramAdmission::cut;
  return may_speak_for(sender, message.body.bytes.subspan(8)) ? DatagramAdmission::pass
                                                              : DatagramAdmission::speaks_for_another;
}

// DDS Security 1.1, 7.3.6: key kind, key, session, and a vector, 20 bytes.
DatagramAdmission encryption_prefix(const Submessage& message) { return at_least(message, 20); }

// Neither vendor looks whether what it says of its own length fits; the bytes are not authenticated yet.
DatagramAdmission encrypted_body(const Submessage& message) {
  const ByteView big{message.body.bytes, false};
  if (big.size() < 4) return DatagramAdmission::cut;
  return big.u32(0) > big.size() - 4 ? DatagramAdmission::cut : DatagramAdmission::pass;
}

// A code of 16 bytes, then counted codes of 20 bytes for single receivers.
DatagramAdmission encryption_postfix(const Submessage& message) {
  const ByteView big{message.body.bytes, false};
  if (big.size() < 20) return DatagramAdmission::cut;
  return big.u32(16) > (big.size() - 20) / 20 ? DatagramAdmission::cut : DatagramAdmission::pass;
}

DatagramAdmission info_timestamp(const Submessage& message) {
  const bool invalidates = (message.flags & kInvalidateFlag) != 0;
  return invalidates ? DatagramAdmission::pass : at_least(message, 8);
}

}  // namespace

bool is_data(const Submessage& message) { return message.id == kData || message.id == kDataFragment; }

bool is_context(const Submessage& message) {
  return message.id == kInfoTimestamp || message.id == kInfoDestination || message.id == kInfoSource;
}

DatagramAdmission examine_submessage(const Submessage& message, const GuidPrefix& sender) {
  switch (message.id) {
    case kPad:
      return DatagramAdmission::pass;
    case kAckNack:
      return acknack(message);
    case kHeartbeat:
      return heartbeat(message);
    case kGap:
      return gap(message);
    case kInfoTimestamp:
      return info_timestamp(message);
    case kInfoSource:
      return info_source(message, sender);
    case kInfoDestination:
      return at_least(message, 12);
    case kNackFragments:
      return nack_fragments(message);
    case kHeartbeatFragments:
      return heartbeat_fragments(message);
    case kData:
      return examine_data(message, sender);
    case kDataFragment:
      return examine_data_fragment(message, sender);
    case kSecBody:
      return encrypted_body(message);
    case kSecPrefix:
    case kSrtpsPrefix:
      return encryption_prefix(message);
    case kSecPostfix:
    case kSrtpsPostfix:
      return encryption_postfix(message);
    default:  // INFO_REPLY (0x0d, 0x0f) among them: neither vendor sends it, and it directs answers elsewhere
      return DatagramAdmission::unknown_submessage;
  }
}

Plain plain_kind_of(const Submessage& message) {
  switch (message.id) {
    case kInfoTimestamp:
    case kInfoDestination:
      return Plain::context;
    case kSecBody:
    case kSecPrefix:
    case kSecPostfix:
      return Plain::speech;
    case kData:  // both have their writer at the same place
    case kDataFragment: {
      const std::uint32_t writer = message.body.entity_id(8);
      const bool early = writer == kParticipants || writer == kHandshakes;
      return early ? Plain::speech : Plain::refused;
    }
    default:
      return Plain::refused;
  }
}

}  // namespace roci::services::vendors::guard
