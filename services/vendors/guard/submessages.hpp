// This file examines the kinds of submessages, one by one.
#pragma once

#include <cstdint>

#include "services/vendors/guard/byte_view.hpp"
#include "services/vendors/guard/datagram_admission.hpp"
#include "services/vendors/guard/parameters.hpp"

namespace roci::services::vendors::guard {

/// Holds one submessage of a message.
struct Submessage {
  std::uint8_t id = 0;
  std::uint8_t flags = 0;
  ByteView body;  ///< bytes after the four of its header
};

/// Returns whether it is DATA or DATA_FRAG.
bool is_data(const Submessage&);
/// Returns whether it only says when, from whom and for whom those behind it are.
bool is_context(const Submessage&);

/// Bounds the numbers of samples that are believed: a writer of a million a second has nine years until then. Fast DDS
/// aborts on a sum of numbers that has no 64 bits.
inline constexpr std::int64_t kHighestNumber = std::int64_t{1} << 48;
/// Returns whether a sample can have this number (RTPS 2.3, 8.3.5.4).
constexpr bool is_number(std::int64_t number) { return number > 0 && number <= kHighestNumber; }

/// `id` is below 0x80; `sender` is the participant of the message's header.
DatagramAdmission examine_submessage(const Submessage&, const GuidPrefix& sender);

/// Says what a submessage is in a secure run if it is not encrypted together with its message.
enum class Plain {
  refused,
  context,  ///< says where and when those behind it belong
  speech,   ///< announcement of a participant, handshake of DDS Security (1.1, 7.4.3), or encrypted itself
};
/// Returns the kind of a well-formed submessage whose id is below 0x80.
Plain plain_kind_of(const Submessage&);

}  // namespace roci::services::vendors::guard
