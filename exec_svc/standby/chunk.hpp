// Chunks go from the leader's journal to the follower's: each is a batch, or a part of a whole journal, as
// plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "exec_svc/journal/batch.hpp"

namespace roci::exec::standby {

/// Holds one message of the journal's copy.
struct Chunk {
  std::uint64_t leader = 0;    ///< epoch of the sender
  journal::Position after;     ///< if a batch: position of the journal that it fits
  journal::Position at;        ///< position of the journal with it
  std::uint32_t part = 0;      ///< numbers this part of a whole journal, from 0
  std::uint32_t parts = 0;     ///< counts the parts of a whole journal; 0: a batch
  std::uint32_t checksum = 0;  ///< covers all other members
  std::string bytes;
  bool operator==(const Chunk&) const = default;
};

/// Returns the CRC-32 over everything but the checksum itself.
std::uint32_t checksum(const Chunk& chunk);

/// Says how much of a whole journal the follower has in a row.
struct TransferProgress {
  journal::Position at;
  std::uint32_t parts = 0;
  bool operator==(const TransferProgress&) const = default;
};

/// So many bytes of a whole journal has each of its parts at most.
inline constexpr std::size_t kPartBytes = 128 * 1024;

/// Splits a whole journal into parts, each sealed with its checksum.
std::vector<Chunk> split(std::uint64_t leader, const journal::Position& at, const std::string& whole);

}  // namespace roci::exec::standby
