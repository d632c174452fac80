// Task networks in binary form (R83): what is sent to the lander. Compact, with its version, its length and a checksum.
//
//   bytes  what
//   7      "ROCIHTN"
//   1      version of the form
//   varint length of the body
//   …      body: texts, then the network, which refers to them (binary_fields.hpp)
//   4      CRC-32 (IEEE 802.3) of all before, little-endian
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::reading {

inline constexpr unsigned kBinaryFormat = 1;
inline constexpr std::string_view kBinaryMagic = "ROCIHTN";
inline constexpr std::size_t kChecksumBytes = 4;

/// Says in what(): "at byte 17: what is wrong; remedy".
class BinaryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns whether the bytes begin as the binary form does.
bool is_binary(std::string_view bytes);

/// Writes a network that was checked; equal networks equally.
std::string to_binary(const model::Network& network);

/// Reads a network whole or throws BinaryError. It is well formed and within model/bounds.hpp by its counts;
/// model::check() says whether it can be used. Memory is taken for what is there, never for what a count promises.
model::Network parse_binary(std::string_view bytes);

}  // namespace roci::planner::utility_htn::reading
