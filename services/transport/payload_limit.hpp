// The payload limit says how large a payload of a topic may be, in five sizes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::services::transport {

/// Bounds the bytes of a serialized sample. A larger one is refused by its writer, and by its reader before it
/// is decoded. A decoded sample takes at most sixteen times as much (tests/fuzz/topics).
enum class PayloadLimit : std::uint32_t {
  word = 16 << 10,     ///< values with names, and nothing that grows with a plan
  page = 256 << 10,    ///< samples with a text in plain words
  batch = 16 << 20,    ///< tuples of functions, trajectories, uploads, previews: a million numbers and more
  plan = 32 << 20,     ///< a plan of some 30,000 activities, or the problem that it solves
  journal = 64 << 20,  ///< a commit of the journal in which such a plan came
};

constexpr std::size_t bytes(PayloadLimit limit) { return static_cast<std::size_t>(limit); }

/// Bounds the padding that a reader may see behind a payload (docs/dds.md).
inline constexpr std::size_t kPayloadPadding = 4;

}  // namespace roci::services::transport
