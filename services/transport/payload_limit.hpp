// How large a payload of a topic may be, in four sizes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::services::transport {

/// Counts bytes of the serialized sample. A larger one is refused by its writer, and by its reader before it is
/// decoded. A decoded sample takes at most sixteen times as much (tests/fuzz/topics).
enum class PayloadLimit : std::uint32_t {
  word = 16 << 10,     ///< Values with names, and nothing that grows with a plan.
  page = 256 << 10,    ///< What has a text in plain words.
  batch = 16 << 20,    ///< Tuples of functions, trajectories, uploads, previews: a million numbers and more.
  plan = 32 << 20,     ///< A plan of some 30,000 activities, or the problem that it solves.
  journal = 64 << 20,  ///< A commit of the journal in which such a plan came.
};

constexpr std::size_t bytes(PayloadLimit limit) { return static_cast<std::size_t>(limit); }

/// A reader may see so much padding behind a payload (docs/dds.md).
inline constexpr std::size_t kPayloadPadding = 4;

}  // namespace roci::services::transport
