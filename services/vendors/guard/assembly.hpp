// Puts samples of another vendor together that came in fragments, so that the vendor's own parser meets none: Fast DDS
// 2.9.1 is ended by an assertion, or turns in a circle, where a late reader finds fragments between gaps (docs/dds.md,
// quirk 22).
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <vector>

#include "services/vendors/guard/identities.hpp"
#include "services/vendors/guard/message.hpp"

namespace roci::services::vendors::guard {

/// Keeps the samples of which some fragments are there. Whoever lacks a sample says so with an acknowledgement; Cyclone
/// DDS answers that with the first fragment alone, and sends the others to who asks for them. Pure: the same messages
/// give the same.
class Assembly {
 public:
  /// Bounds what is kept: the sample that has waited longest for a fragment is forgotten, and asked for anew.
  static constexpr std::size_t kMostBytes = 2 * std::size_t{kMaxSampleBytes};
  static constexpr std::size_t kMostSamples = 256;

  /// Takes the fragments of user data out of a message that passed (message.hpp) and is of another vendor than
  /// `own_vendor`; returns what is left of its length, 0 if that says nothing. Each sample that is complete now is
  /// appended to `whole`, as a message of its own that passes as well.
  std::size_t take(std::span<std::uint8_t> message, std::uint16_t own_vendor,
                   std::vector<std::vector<std::uint8_t>>& whole);

  /// Returns what is to be sent instead of this message of the same process: where it acknowledges, it no longer asks
  /// for whole samples of which some fragments are here, but for the fragments that are missing. Empty, as mostly: it
  /// is to be sent as it is.
  std::vector<std::uint8_t> with_requests(std::span<const std::uint8_t> message);

  std::size_t kept_bytes() const { return bytes_; }

 private:
  struct Sample {
    GuidPrefix sender{};
    std::uint32_t writer = 0;
    std::int64_t number = 0;
    std::uint32_t size = 0;
    std::uint16_t fragment_size = 0;
    std::vector<std::uint8_t> payload;
    std::vector<bool> there;  // fragments
    std::size_t missing = 0;
    std::vector<std::uint8_t> inline_qos;
  };

  std::optional<std::vector<std::uint8_t>> add(std::span<const std::uint8_t> header, const Submessage& fragment,
                                               std::span<const std::uint8_t> context);
  void request(const Sample&, std::span<const std::uint8_t> reader_and_writer, std::vector<std::uint8_t>& out);
  Sample& sample_of(const GuidPrefix& sender, const ByteView& body);
  void forget(std::list<Sample>::iterator);

  std::list<Sample> samples_;  // the one that got a fragment last is the last
  std::size_t bytes_ = 0;
  std::uint32_t requests_ = 0;  // so far, since each has a number
};

}  // namespace roci::services::vendors::guard
