#include "services/vendors/guard/submessages.hpp"

#include "services/vendors/guard/data.hpp"

namespace roci::services::vendors::guard {
namespace {

constexpr std::uint32_t kMaxBits = 256;  // of a set of sequence or fragment numbers (RTPS 2.3, 9.4.2.6)
// Fast DDS walks through a gap number by number. From number 1 on that costs time alone, 3 ns each; a gap further up
// is kept, number by number.
constexpr std::int64_t kLongestGapFromStart = std::int64_t{1} << 28;
constexpr std::int64_t kLongestGap = std::int64_t{1} << 18;

std::size_t bytes_of_bits(std::uint32_t bits) { return (bits + 31) / 32 * 4; }

Verdict at_least(const Submessage& message, std::size_t size) {
  return message.body.size() < size ? Verdict::cut : Verdict::pass;
}

Verdict acknack(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 24) return Verdict::cut;
  const std::int64_t base = body.sequence_number(8);
  const std::uint32_t bits = body.u32(16);
  const bool preemptive = base == 0 && bits == 0;  // Fast DDS sends these before it knows the writer
  if (bits > kMaxBits || (base <= 0 && !preemptive)) return Verdict::bad_numbers;
  return at_least(message, 24 + bytes_of_bits(bits));
}

Verdict heartbeat(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return Verdict::cut;
  const std::int64_t first = body.sequence_number(8), last = body.sequence_number(16);
  return first <= 0 || last < first - 1 ? Verdict::bad_numbers : Verdict::pass;
}

Verdict gap(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return Verdict::cut;
  const std::int64_t start = body.sequence_number(8), base = body.sequence_number(16);
  const std::uint32_t bits = body.u32(24);
  if (start <= 0 || base <= 0 || bits > kMaxBits) return Verdict::bad_numbers;
  if (base - start > (start == 1 ? kLongestGapFromStart : kLongestGap)) return Verdict::bad_numbers;
  return at_least(message, 28 + bytes_of_bits(bits));
}

Verdict nack_fragments(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 28) return Verdict::cut;
  const std::uint32_t base = body.u32(16), bits = body.u32(20);
  if (body.sequence_number(8) <= 0 || base == 0 || bits > kMaxBits) return Verdict::bad_numbers;
  return at_least(message, 28 + bytes_of_bits(bits));
}

Verdict heartbeat_fragments(const Submessage& message) {
  const ByteView& body = message.body;
  if (body.size() < 24) return Verdict::cut;
  return body.sequence_number(8) <= 0 || body.u32(16) == 0 ? Verdict::bad_numbers : Verdict::pass;
}

Verdict info_source(const Submessage& message, const GuidPrefix& sender) {
  if (message.body.size() < 20) return Verdict::cut;
  return may_speak_for(sender, message.body.bytes.subspan(8)) ? Verdict::pass : Verdict::speaks_for_another;
}

// DDS Security 1.1, 7.3.6: key kind, key, session, and a vector, 20 bytes.
Verdict encryption_prefix(const Submessage& message) { return at_least(message, 20); }

// Neither vendor looks whether what it says of its own length fits; the bytes are not authenticated yet.
Verdict encrypted_body(const Submessage& message) {
  const ByteView big{message.body.bytes, false};
  if (big.size() < 4) return Verdict::cut;
  return big.u32(0) > big.size() - 4 ? Verdict::cut : Verdict::pass;
}

// A code of 16 bytes, then counted codes of 20 bytes for single receivers.
Verdict encryption_postfix(const Submessage& message) {
  const ByteView big{message.body.bytes, false};
  if (big.size() < 20) return Verdict::cut;
  return big.u32(16) > (big.size() - 20) / 20 ? Verdict::cut : Verdict::pass;
}

Verdict info_timestamp(const Submessage& message) {
  const bool invalidates = (message.flags & 0x02) != 0;
  return invalidates ? Verdict::pass : at_least(message, 8);
}

}  // namespace

Verdict examine_submessage(const Submessage& message, const GuidPrefix& sender) {
  switch (message.id) {
    case 0x01:  // PAD
      return Verdict::pass;
    case 0x06:
      return acknack(message);
    case 0x07:
      return heartbeat(message);
    case 0x08:
      return gap(message);
    case 0x09:
      return info_timestamp(message);
    case 0x0c:
      return info_source(message, sender);
    case 0x0e:  // INFO_DST
      return at_least(message, 12);
    case 0x12:
      return nack_fragments(message);
    case 0x13:
      return heartbeat_fragments(message);
    case 0x15:
      return examine_data(message, sender);
    case 0x16:
      return examine_data_fragment(message, sender);
    case 0x30:  // SEC_BODY
      return encrypted_body(message);
    case 0x31:  // SEC_PREFIX
    case 0x33:  // SRTPS_PREFIX
      return encryption_prefix(message);
    case 0x32:  // SEC_POSTFIX
    case 0x34:  // SRTPS_POSTFIX
      return encryption_postfix(message);
    default:  // INFO_REPLY (0x0d, 0x0f) among them: neither vendor sends it, and it directs answers elsewhere
      return Verdict::unknown_submessage;
  }
}

Plain plain_kind_of(const Submessage& message) {
  switch (message.id) {
    case 0x09:  // INFO_TS
    case 0x0e:  // INFO_DST
      return Plain::context;
    case 0x30:  // SEC_BODY, SEC_PREFIX, SEC_POSTFIX
    case 0x31:
    case 0x32:
      return Plain::speech;
    case 0x15:  // DATA and DATA_FRAG have their writer at the same place
    case 0x16: {
      const ByteView writer{message.body.part(8, 4).bytes, false};
      const bool early =
          writer.u32(0) == 0x000100c2 || writer.u32(0) == 0x000201c3;  // participants; the handshake
      return early ? Plain::speech : Plain::refused;
    }
    default:
      return Plain::refused;
  }
}

}  // namespace roci::services::vendors::guard
