/// The version of a journal: of its tables, and of the texts and numbers in them. docs/formats.md publishes
/// it.
#pragma once

#include <cstdint>

struct sqlite3;

namespace roci::exec::journal {

/// The newest version that this code reads; it writes this one. It rises when a table, the meaning of a
/// column or the form of a decision's line changes.
inline constexpr int kFormat = 1;

/// The version of inputs and snapshots, which the journal states as its number `format`. It rises when
/// reactor/message_fields.hpp or the reactor's snapshot change. Those of another version are never read: the
/// executive keeps goals and plan numbers and plans anew, roci-replay refuses.
inline constexpr std::int64_t kInputFormat = 10;

/// Leaves an open journal at kFormat. A journal that states no version is of version 1, as baseline-05 wrote
/// them; older versions are brought up here, step by step. Throws NewerJournal for a newer one; nothing has
/// changed then.
void settle_format(sqlite3* database);

}  // namespace roci::exec::journal
