#include "services/vendors/guard/assembly.hpp"

#include <algorithm>
#include <iterator>

#include "services/vendors/guard/data.hpp"
#include "services/vendors/guard/parameters.hpp"
#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {
namespace {

constexpr std::size_t kVendorAt = 6;
constexpr std::size_t kAckNackSize = 20;      // up to its bits
constexpr std::uint8_t kFragmentKeyFlag = 4;  // where DATA has kDataFlag (RTPS 2.3, 9.4.5.4)

void append(std::vector<std::uint8_t>& out, std::span<const std::uint8_t> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

void append_u16(std::vector<std::uint8_t>& out, std::uint16_t value, bool little_endian) {
  const auto low = static_cast<std::uint8_t>(value), high = static_cast<std::uint8_t>(value >> 8);
  out.push_back(little_endian ? low : high);
  out.push_back(little_endian ? high : low);
}

void append_u32(std::vector<std::uint8_t>& out, std::uint32_t value) {
  append_u16(out, static_cast<std::uint16_t>(value), true);
  append_u16(out, static_cast<std::uint16_t>(value >> 16), true);
}

// Takes the sample out of those that an ACKNACK asks for; `parsed` is its body, and `body` a copy to be changed.
void unask(std::span<std::uint8_t> body, const ByteView& parsed, std::int64_t number) {
  const std::int64_t bit = number - parsed.sequence_number(8);
  if (bit < 0 || bit >= parsed.u32(16)) return;
  const std::size_t word = kAckNackSize + static_cast<std::size_t>(bit) / 32 * 4, in_word = 31 - bit % 32;
  const std::size_t byte = word + (parsed.little_endian ? in_word / 8 : 3 - in_word / 8);
  if (byte < body.size()) body[byte] &= static_cast<std::uint8_t>(~(1U << in_word % 8));
}

}  // namespace

std::size_t Assembly::take(std::span<std::uint8_t> message, std::uint16_t own_vendor,
                           std::vector<std::vector<std::uint8_t>>& whole) {
  if (ByteView{message, false}.u16(kVendorAt) == own_vendor) return message.size();
  const std::span<const std::uint8_t> header = message.first(kHeaderSize);
  std::vector<std::uint8_t> context;
  bool speaks = false;
  const auto keep = [&](std::span<const std::uint8_t> one, const Submessage& parsed) {
    const bool fragment = parsed.id == kDataFragment && is_of_user(parsed);
    if (is_context(parsed)) append(context, one);
    speaks = speaks || !(fragment || is_context(parsed));
    auto complete = fragment ? add(header, parsed, context) : std::nullopt;
    if (complete && examine(*complete) == DatagramAdmission::pass) whole.push_back(*std::move(complete));
    return !fragment;
  };
  const std::size_t left = strip_submessages(message, keep);
  return speaks ? left : 0;
}

Assembly::Sample& Assembly::sample_of(const GuidPrefix& sender, const ByteView& body) {
  const std::uint32_t writer = body.entity_id(8), size = body.u32(28);
  const std::int64_t number = body.sequence_number(12);
  const std::uint16_t fragment_size = body.u16(26);
  const auto known = std::ranges::find_if(samples_, [&](const Sample& one) {
    return one.sender == sender && one.writer == writer && one.number == number;
  });
  if (known != samples_.end()) {
    if (known->size == size && known->fragment_size == fragment_size) {
      samples_.splice(samples_.end(), samples_, known);
      return samples_.back();
    }
    forget(known);  // another one of that number
  }
  while (!samples_.empty() && (bytes_ + size > kMostBytes || samples_.size() >= kMostSamples))
    forget(samples_.begin());
  const std::size_t fragments = (std::size_t{size} + fragment_size - 1) / fragment_size;
  samples_.push_back({sender, writer, number, size, fragment_size, std::vector<std::uint8_t>(size),
                      std::vector<bool>(fragments), fragments, {}});
  bytes_ += size;
  return samples_.back();
}

void Assembly::forget(std::list<Sample>::iterator sample) {
  bytes_ -= sample->size;
  samples_.erase(sample);
}

std::vector<std::uint8_t> Assembly::with_requests(std::span<const std::uint8_t> message) {
  constexpr std::size_t kAtOnce = 16;  // samples
  if (samples_.empty() || message.size() < kHeaderSize) return {};
  std::vector<std::uint8_t> out(message.begin(), message.end()), requests;
  std::span<const std::uint8_t> destination;
  std::size_t asked = 0;
  for_each_submessage(message, [&](const Submessage& one) {
    if (one.id == kInfoDestination && one.body.size() >= 12) destination = one.body.bytes.first(12);
    if (one.id != kAckNack || one.body.size() < kAckNackSize || destination.empty()) return;
    const std::uint32_t writer = one.body.entity_id(4);
    const auto at = static_cast<std::size_t>(one.body.bytes.data() - message.data());
    for (const Sample& sample : samples_) {
      if (sample.writer != writer || !std::ranges::equal(sample.sender, destination)) continue;
      unask(std::span(out).subspan(at, one.body.size()), one.body, sample.number);
      if (asked++ < kAtOnce) request(sample, one.body.bytes.first(8), requests);
    }
  });
  if (asked == 0) return {};
  append(out, requests);
  return out;
}

// Appends INFO_DST and NACK_FRAG for the first fragments that are missing.
void Assembly::request(const Sample& sample, std::span<const std::uint8_t> reader_and_writer,
                       std::vector<std::uint8_t>& out) {
  constexpr std::size_t kBits = 256;  // of a set of fragment numbers
  const auto base = static_cast<std::size_t>(std::ranges::find(sample.there, false) - sample.there.begin());
  const std::size_t bits = std::min(kBits, sample.there.size() - base);
  std::vector<std::uint32_t> words((bits + 31) / 32, 0);
  for (std::size_t i = 0; i < bits; ++i)
    if (!sample.there[base + i]) words[i / 32] |= 1U << (31 - i % 32);
  out.insert(out.end(), {kInfoDestination, kLittleEndianFlag, 12, 0});
  append(out, sample.sender);
  out.insert(out.end(), {kNackFragments, kLittleEndianFlag});
  append_u16(out, static_cast<std::uint16_t>(28 + 4 * words.size()), true);
  append(out, reader_and_writer);
  append_u32(out, static_cast<std::uint32_t>(sample.number >> 32));
  append_u32(out, static_cast<std::uint32_t>(sample.number));
  append_u32(out, static_cast<std::uint32_t>(base + 1));
  append_u32(out, static_cast<std::uint32_t>(bits));
  for (const std::uint32_t word : words) append_u32(out, word);
  append_u32(out, ++requests_);
}

// The fragment is well-formed (data.cpp). Returns the message of the whole sample, as DATA that reaches to its end.
std::optional<std::vector<std::uint8_t>> Assembly::add(std::span<const std::uint8_t> header,
                                                       const Submessage& fragment,
                                                       std::span<const std::uint8_t> context) {
  const ByteView& body = fragment.body;
  Sample& sample = sample_of(sender_of(header), body);
  ByteView rest = body.from(4 + std::size_t{body.u16(2)});
  if ((fragment.flags & kInlineQosFlag) != 0) {
    const std::size_t length = examine_parameters(rest, ListKind::inline_qos, std::nullopt).size;
    if (sample.inline_qos.empty()) append(sample.inline_qos, rest.bytes.first(length));
    rest = rest.from(length);
  }
  const std::size_t first = body.u32(20) - 1, count = body.u16(24);
  for (std::size_t i = 0; i < count; ++i) {
    if (sample.there[first + i]) continue;
    const std::size_t at = (first + i) * sample.fragment_size;
    const std::size_t length = std::min<std::size_t>(sample.fragment_size, sample.size - at);
    const auto bytes = rest.bytes.subspan(i * sample.fragment_size, length);
    std::ranges::copy(bytes, sample.payload.begin() + static_cast<std::ptrdiff_t>(at));
    sample.there[first + i] = true;
    --sample.missing;
  }
  if (sample.missing > 0) return std::nullopt;
  const bool key = (fragment.flags & kFragmentKeyFlag) != 0, qos = !sample.inline_qos.empty();
  std::vector<std::uint8_t> out(header.begin(), header.end());
  append(out, context);
  out.push_back(kData);
  out.push_back(static_cast<std::uint8_t>((body.little_endian ? kLittleEndianFlag : 0) |
                                          (qos ? kInlineQosFlag : 0) | (key ? kKeyFlag : kDataFlag)));
  append_u16(out, 0, body.little_endian);  // to the end of the message
  append_u16(out, 0, body.little_endian);
  append_u16(out, 16, body.little_endian);  // from here to the inline QoS
  append(out, body.bytes.subspan(4, 16));   // reader, writer, number
  append(out, sample.inline_qos);
  append(out, sample.payload);
  forget(std::prev(samples_.end()));
  return out;
}

}  // namespace roci::services::vendors::guard
