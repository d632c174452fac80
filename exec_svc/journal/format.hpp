// The version of a journal is that of its tables, and of the texts and numbers in them. docs/formats.md
// publishes it.
#pragma once

#include <cstdint>
#include <string>

struct sqlite3;

namespace roci::exec::journal {

/// Numbers the newest version that this code reads, and the one that it writes. It rises when a table, the meaning
/// of a column or the form of a decision's line changes.
inline constexpr int kFormat = 1;

/// The version of inputs and snapshots, which the journal states as its number `format`. It rises when
/// reactor/message_fields.hpp or the reactor's snapshot change. Those of another version are never read: the
/// executive keeps goals and plan numbers and plans anew, roci-replay refuses.
inline constexpr std::int64_t kInputFormat = 15;

/// Returns what a journal of a version also states in SQLite's application_id, so that one flipped byte is not taken
/// for a newer version.
constexpr std::int32_t stamp_of(std::int32_t version) {  // of a damaged one, too
  return static_cast<std::int32_t>(0x524f0000U + static_cast<std::uint32_t>(version));
}

/// Holds what a journal states of its version, in two places.
struct StatedFormat {
  std::int32_t version = 0;  ///< user_version; 0: none
  std::int32_t stamp = 0;    ///< application_id; 0: none, as before there was a second place
  bool newer() const { return version > kFormat && stamp == stamp_of(version); }
  /// Returns whether the places contradict each other, so that the journal is damaged.
  bool contradicts_itself() const { return version > kFormat && !newer(); }
};
/// Reads what the database states. Throws JournalError where it cannot be read.
StatedFormat stated_format(sqlite3* database);
std::string to_text(const StatedFormat& stated);

/// Throws NewerJournal for a journal of a newer version, and JournalError for one whose places contradict each other.
void require_known_format(const StatedFormat& stated);

/// Leaves an open journal at kFormat, stated in both places. A journal that states no version is of version 1, as
/// baseline-05 wrote them; older versions are brought up here, step by step. Throws as require_known_format() does;
/// nothing has changed then.
void settle_format(sqlite3* database);

}  // namespace roci::exec::journal
