/// A journal as a numbered row of changes, for copies elsewhere.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace roci::exec::journal {

/// Names the newest commit of a journal. Only the leader of an epoch makes commits of that epoch, each from the
/// one before: two journals with the same position are the same journal. {0, 0}: an empty one.
struct Position {
  std::uint64_t epoch = 0;
  std::uint64_t sequence = 0;  ///< rises by one with each commit, over all epochs
  auto operator<=>(const Position&) const = default;
};

/// Stands for a journal that no other has as a part.
inline constexpr Position kForkedHistory{0, 1};

/// What one commit changed.
struct Batch {
  Position after;       ///< of the journal before it
  Position at;          ///< of the journal with it
  std::string changes;  ///< an SQLite changeset
};

}  // namespace roci::exec::journal
