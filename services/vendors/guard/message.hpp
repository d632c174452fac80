// Judges RTPS messages before a vendor's parser sees them. Pure: the same bytes give the same admission.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "services/vendors/guard/datagram_admission.hpp"
#include "services/vendors/guard/gaps.hpp"
#include "services/vendors/guard/parameters.hpp"
#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {

inline constexpr std::size_t kHeaderSize = 20;  ///< of an RTPS message

/// A message that passes is well-formed down to its submessages (RTPS 2.3, 8.3 and 9.4), claims no sample over
/// kMaxSampleBytes, and speaks in discovery for its sender alone. What DDS Security has encrypted passes as it is;
/// payloads of user topics are not looked into. It never says `stranger`, `taken_identity` or `crowd`.
DatagramAdmission examine(std::span<const std::uint8_t> datagram);

/// Says what is in a message, so that what it has not is not looked for.
struct Contents {
  bool vendors_own = false;  ///< submessages that strip_vendor_submessages() takes out
  bool discovery = false;    ///< data of discovery
  bool data = false;         ///< any data
  SkippedNumbers skipped{};
};
/// Tells the contents, too; of a message that does not pass, up to where it fails.
DatagramAdmission examine(std::span<const std::uint8_t> datagram, Contents&);

/// Returns the participant that a message says it is from. The message must have an RTPS header.
GuidPrefix sender_of(std::span<const std::uint8_t> message);

/// Calls `see` with each submessage of a message that has an RTPS header, in its order,
/// up to the first one that does not fit.
void for_each_submessage(std::span<const std::uint8_t> message,
                         const std::function<void(const Submessage&)>& see);

/// Calls `see` with each key hash of user data in a message that passed, where it stands: it may be changed there.
void for_each_key_hash(std::span<std::uint8_t> message,
                       const std::function<void(std::span<std::uint8_t, 16>)>& see);

/// Takes out of a message that passed what `keep` does not keep, and returns the new length. It is told each submessage
/// with its header, and taken apart.
std::size_t strip_submessages(
    std::span<std::uint8_t> message,
    const std::function<bool(std::span<const std::uint8_t> with_header, const Submessage&)>& keep);

/// Takes the vendors' own submessages (ids from 0x80 on) out of a message that passed and returns its new length.
/// Nobody here needs them: Fast DDS adds statistics to each of its messages, and Debian's build aborts when it reads
/// unlikely ones.
std::size_t strip_vendor_submessages(std::span<std::uint8_t> message);

/// Takes out of a message that passed what says that a participant leaves, and returns the new length. Who does not
/// hear it gives that participant up when its lease is over.
std::size_t strip_farewells(std::span<std::uint8_t> message);

/// Takes out of a message of a secure run, one that passed and has no vendor's submessages, what must not be read in
/// plain, and returns the new length; 0 if nothing is left that says something. A message that is encrypted as a
/// whole stays; else what precedes the exchange of keys (announcement of participants, handshake) stays, and
/// submessages that are encrypted one by one. Cyclone DDS sends acknowledgements and heartbeats of its plain
/// discovery together with the handshake; these are taken out.
std::size_t strip_plain_submessages(std::span<std::uint8_t> message);

/// Moves plain submessages of a secure run before those that are encrypted one by one. strip_plain_submessages has
/// left nothing in plain but announcements and handshakes. Cyclone DDS packs the last message of a handshake behind an
/// acknowledgement that only the end of that handshake makes readable; Fast DDS stops reading where it cannot decrypt
/// (MessageReceiver::processCDRMsg), and would never see that last message. A message whose parts are for several
/// participants stays as it is.
void put_plain_submessages_first(std::span<std::uint8_t> message);

}  // namespace roci::services::vendors::guard
