#include "services/vendors/guard/message.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "services/vendors/guard/data.hpp"
#include "services/vendors/guard/gaps.hpp"
#include "services/vendors/guard/rtps_ids.hpp"
#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {
namespace {

constexpr std::size_t kSubmessageHeaderSize = 4;

// Of the submessage at the beginning of these bytes.
bool is_little_endian(std::span<const std::uint8_t> rest) { return (rest[1] & kLittleEndianFlag) != 0; }

// Takes apart the submessage of which these are the bytes.
Submessage parsed(std::span<const std::uint8_t> one) {
  return {one[0], one[1], ByteView{one.subspan(kSubmessageHeaderSize), is_little_endian(one)}};
}

// Where a submessage ends, seen from its own beginning; 0 if it reaches over the end of the message.
std::size_t size_of_first(std::span<const std::uint8_t> rest) {
  if (rest.size() < kSubmessageHeaderSize) return 0;
  const ByteView header{rest, is_little_endian(rest)};
  const std::size_t length = header.u16(2);
  // Length 0 reaches to the end of the message, but for the two kinds that may be empty (RTPS 2.3, 8.3.3.2.3).
  if (length == 0) return rest[0] == kPad || rest[0] == kInfoTimestamp ? kSubmessageHeaderSize : rest.size();
  if (length % 4 != 0 || length > rest.size() - kSubmessageHeaderSize) return 0;
  return kSubmessageHeaderSize + length;
}

// Moves what is kept together, behind the header; returns the new length.
template <class Keep>
std::size_t strip(std::span<std::uint8_t> message, Keep keep) {
  std::size_t end = kHeaderSize;
  for (std::size_t at = kHeaderSize; at < message.size();) {
    const std::size_t size = size_of_first(message.subspan(at));
    if (keep(message.subspan(at, size))) {
      if (end != at) std::memmove(message.data() + end, message.data() + at, size);
      end += size;
    }
    at += size;
  }
  return end;
}

// The participants' writer disposes or unregisters a participant, which a sample without data does as well.
bool is_farewell(std::span<const std::uint8_t> one) {
  if (one[0] != kData) return false;
  const ByteView body = parsed(one).body;
  if (body.entity_id(8) != kParticipants) return false;
  if ((one[1] & kDataFlag) == 0) return true;
  if ((one[1] & kInlineQosFlag) == 0) return false;
  const auto status = find_parameter(body.from(4 + std::size_t{body.u16(2)}), kStatusInfo);
  return status && (status->bytes[3] & kNotAlive) != 0;
}

// SRTPS_PREFIX, SEC_BODY, SRTPS_POSTFIX and nothing else (DDS Security 1.1, 7.3.6.6): a parser that meets the prefix
// later reads the rest in plain.
bool is_encrypted(std::span<const std::uint8_t> message) {
  auto rest = message.subspan(kHeaderSize);
  for (const std::uint8_t id : {kSrtpsPrefix, kSecBody, kSrtpsPostfix}) {
    if (rest.empty() || rest[0] != id) return false;
    rest = rest.subspan(size_of_first(rest));
  }
  return rest.empty();
}

// SEC_BODY, SEC_PREFIX and SEC_POSTFIX.
bool is_one_encrypted(std::span<const std::uint8_t> one) {
  return one[0] >= kSecBody && one[0] <= kSecPostfix;
}

// Returns whether data in plain stand behind what is encrypted one by one, in a message whose parts may change places.
bool hides_plain_data(std::span<const std::uint8_t> message) {
  std::span<const std::uint8_t> destination;
  bool encrypted = false;
  bool hidden = false;
  for (auto rest = message.subspan(kHeaderSize); !rest.empty();) {
    const auto one = rest.first(size_of_first(rest));
    rest = rest.subspan(one.size());
    // What reaches to the end of the message by a length of 0 must stay there.
    if (one.size() != kSubmessageHeaderSize + ByteView{one, is_little_endian(one)}.u16(2)) return false;
    if (one[0] == kInfoDestination) {
      const bool another = encrypted && !std::ranges::equal(destination, one);
      if (another) return false;
      destination = one;
    }
    encrypted = encrypted || is_one_encrypted(one);
    hidden = hidden || (encrypted && (one[0] == kData || one[0] == kDataFragment));
  }
  return hidden;
}

}  // namespace

DatagramAdmission examine(std::span<const std::uint8_t> datagram) {
  Contents contents;
  return examine(datagram, contents);
}

DatagramAdmission examine(std::span<const std::uint8_t> datagram, Contents& contents) {
  if (datagram.size() < kHeaderSize || std::memcmp(datagram.data(), "RTPS", 4) != 0 || datagram[4] != 2) {
    return DatagramAdmission::no_rtps;
  }
  const GuidPrefix sender = sender_of(datagram);
  contents = {};
  for (auto rest = datagram.subspan(kHeaderSize); !rest.empty();) {
    const std::size_t size = size_of_first(rest);
    if (size == 0) return DatagramAdmission::cut;
    if (rest[0] < kFirstOfVendors) {
      const Submessage one = parsed(rest.first(size));
      const DatagramAdmission admission = examine_submessage(one, sender);
      if (admission != DatagramAdmission::pass) return admission;
      contents.skipped += skipped_by(one);
      if (!contents.skipped.fits_one_datagram()) return DatagramAdmission::bad_numbers;
      contents.data = contents.data || is_data(one);
      contents.discovery = contents.discovery || (is_data(one) && !is_of_user(one));
    } else {
      contents.vendors_own = true;
    }
    rest = rest.subspan(size);
  }
  return DatagramAdmission::pass;
}

GuidPrefix sender_of(std::span<const std::uint8_t> message) {
  GuidPrefix prefix;
  std::copy_n(message.begin() + 8, prefix.size(), prefix.begin());
  return prefix;
}

void for_each_submessage(std::span<const std::uint8_t> message,
                         const std::function<void(const Submessage&)>& see) {
  for (auto rest = message.subspan(kHeaderSize); !rest.empty();) {
    const std::size_t size = size_of_first(rest);
    if (size == 0) return;
    see(parsed(rest.first(size)));
    rest = rest.subspan(size);
  }
}

void for_each_key_hash(std::span<std::uint8_t> message,
                       const std::function<void(std::span<std::uint8_t, 16>)>& see) {
  for_each_submessage(message, [&](const Submessage& one) {
    if (!is_data(one) || (one.flags & kInlineQosFlag) == 0 || !is_of_user(one)) return;
    const ByteView inline_qos = one.body.from(4 + std::size_t{one.body.u16(2)});
    for_each_parameter(inline_qos, kKeyHash, [&](const ByteView& hash) {
      const auto at = static_cast<std::size_t>(hash.bytes.data() - message.data());
      see(message.subspan(at).first<16>());
    });
  });
}

std::size_t strip_submessages(
    std::span<std::uint8_t> message,
    const std::function<bool(std::span<const std::uint8_t> with_header, const Submessage&)>& keep) {
  return strip(message, [&](std::span<const std::uint8_t> one) { return keep(one, parsed(one)); });
}

std::size_t strip_vendor_submessages(std::span<std::uint8_t> message) {
  return strip(message, [](std::span<const std::uint8_t> one) { return one[0] < kFirstOfVendors; });
}

std::size_t strip_farewells(std::span<std::uint8_t> message) {
  return strip(message, [](std::span<const std::uint8_t> one) { return !is_farewell(one); });
}

std::size_t strip_plain_submessages(std::span<std::uint8_t> message) {
  if (is_encrypted(message)) return message.size();
  bool speaks = false;
  const std::size_t length = strip(message, [&speaks](std::span<const std::uint8_t> one) {
    const Plain kind = plain_kind_of(parsed(one));
    speaks = speaks || kind == Plain::speech;
    return kind != Plain::refused;
  });
  return speaks ? length : 0;
}

void put_plain_submessages_first(std::span<std::uint8_t> message) {
  if (!hides_plain_data(message)) return;
  std::vector<std::uint8_t> encrypted;
  const std::size_t end = strip(message, [&encrypted](std::span<const std::uint8_t> one) {
    if (!is_one_encrypted(one)) return true;
    encrypted.insert(encrypted.end(), one.begin(), one.end());
    return false;
  });
  std::ranges::copy(encrypted, message.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace roci::services::vendors::guard
