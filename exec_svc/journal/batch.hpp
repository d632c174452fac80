// Batches make a journal a numbered sequence of changes, for copies elsewhere.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace roci::exec::journal {

/// Names the newest commit of a journal; {0, 0} is an empty one. Only the leader of an epoch makes commits of
/// that epoch, each from the one before, so two journals with the same position are equal.
struct Position {
  std::uint64_t epoch = 0;
  std::uint64_t sequence = 0;  ///< rises by one with each commit, over all epochs
  auto operator<=>(const Position&) const = default;
};

/// Stands for a journal of which no other one is a continuation.
inline constexpr Position kForkedHistory{0, 1};

/// Holds what one commit changed.
struct Batch {
  Position after;       ///< position of the journal before it
  Position at;          ///< position of the journal with it
  std::string changes;  ///< an SQLite changeset
};

}  // namespace roci::exec::journal
