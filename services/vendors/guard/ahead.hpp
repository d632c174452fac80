// Samples are ahead at a reliable reader that waits for an earlier one of their writer. Fast DDS keeps them all until
// that one comes, which is whenever the writer likes; this file bounds them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "services/vendors/guard/message.hpp"

namespace roci::services::vendors::guard {

/// Knows from the acknowledgements of this process up to where its readers have what each writer wrote, and which data
/// have come since. What is taken out is lost for now: the reader goes on to ask for it, and takes it in its turn,
/// since the sample that it waits for always passes. Pure: the same messages give the same.
class SamplesAhead {
 public:
  /// Bound what all readers of a participant keep so, in samples and in bytes of their payloads.
  static constexpr std::size_t kMostSamples = 65'536, kMostBytes = std::size_t{64} << 20;
  /// Bounds the pairs of a reader and its writer that are known. Beyond it those are forgotten of which nothing is
  /// kept: their data pass uncounted until they are acknowledged again.
  static constexpr std::size_t kPairs = kMostSamples + 16'384;

  /// Takes in what a message of this process acknowledges.
  void acknowledge(std::span<const std::uint8_t> message);

  /// Takes the data for which there is no room out of a message that passed, and returns what is left of its length, 0
  /// if that says nothing. `refused` counts them.
  std::size_t take(std::span<std::uint8_t> message, std::size_t& refused);

  /// Takes in that the vendor has given this participant up, and with it what it kept of it.
  void gave_up(const GuidPrefix&);

  std::size_t samples() const { return samples_; }
  std::size_t bytes() const { return bytes_; }
  std::size_t pairs() const { return pairs_; }

 private:
  using Writer = std::pair<GuidPrefix, std::uint32_t>;
  using Reader = std::uint32_t;

  struct Expected {
    std::int64_t next = 0;                         // the first sample that the reader lacks
    std::map<std::int64_t, std::uint32_t> ahead;  // bytes of each that has come, from there on
  };

  Expected& expected_of(const Writer&, Reader);
  void forget_idle();
  bool admits(const GuidPrefix& sender, const Submessage& data);
  void forget_up_to(Expected&, std::int64_t next);

  std::map<Writer, std::map<Reader, Expected>> writers_;
  std::size_t pairs_ = 0;
  std::size_t samples_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace roci::services::vendors::guard
