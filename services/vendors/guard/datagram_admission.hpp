// A verdict is what the guard says of a datagram, and what it counts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace roci::services::vendors::guard {

/// Everything but `pass` means that the vendor never sees the datagram.
enum class DatagramAdmission : std::uint8_t {
  pass,
  stranger,  ///< It comes from an address that is neither a configured peer's nor this host's own.
  no_rtps,   ///< It has no RTPS header of version 2.
  cut,       ///< A submessage reaches over the end, or is shorter than its kind must be.
  unknown_submessage,  ///< An id below 0x80 that RTPS 2.3 and DDS Security 1.1 do not define, or that redirects answers.
  bad_numbers,   ///< Sequence or fragment numbers that RTPS 2.3 (8.3.5, 8.3.7) forbids, or gaps beyond gaps.hpp.
  bad_fragment,  ///< A fragment that lies outside its sample or is not there, or fragmented discovery.
  oversized,     ///< A fragment of a sample of more than kMaxSampleBytes, or discovery beyond kMaxDiscoveryBytes.
  bad_parameters,      ///< A parameter list, or a known parameter in one, that does not fit into its bytes.
  speaks_for_another,  ///< Its discovery data or INFO_SRC names the GUID of a participant that is not its sender.
  taken_identity,  ///< Its GUID prefix names another port, or was heard from another address or port first.
  crowd,  ///< A new GUID prefix from an address or port, or a new endpoint, where there are as many as are allowed.
  too_far_ahead,  ///< Data that came before one that is missing, beyond ahead.hpp; one sample each.
  plain,           ///< In a secure run: nothing in it is encrypted that must be. It is counted, and not told.
};

inline constexpr std::array<std::string_view, 14> kAdmissionNames{"pass",
                                                                  "stranger",
                                                                  "no_rtps",
                                                                  "cut",
                                                                  "unknown_submessage",
                                                                  "bad_numbers",
                                                                  "bad_fragment",
                                                                  "oversized",
                                                                  "bad_parameters",
                                                                  "speaks_for_another",
                                                                  "taken_identity",
                                                                  "crowd",
                                                                  "too_far_ahead",
                                                                  "plain"};
inline constexpr std::size_t kAdmissions = kAdmissionNames.size();

/// Bounds a sample that is taken in, in bytes: a plan of 8,000 activities has about 4 MiB.
inline constexpr std::uint32_t kMaxSampleBytes = 16u * 1024 * 1024;

/// Bounds what a participant says of itself or of one endpoint, in bytes; ours take 1,800 and 800 at most, and vendors
/// keep all of it.
inline constexpr std::size_t kMaxDiscoveryBytes = std::size_t{16} * 1024;

}  // namespace roci::services::vendors::guard
