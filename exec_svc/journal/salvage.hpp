// Salvage deals with a damaged journal: the damaged file is kept, what can be read of it begins a new one, and the
// executive starts in doubt.
#pragma once

#include <filesystem>
#include <string>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::journal {

/// Names the journal's text that tells the ground how the journal was damaged; the text is empty if it is
/// whole or the ground knows.
inline constexpr char kDamage[] = "damage";

/// Says what is wrong with a journal, in plain words; empty for one that is whole, and where there is none. Every page,
/// goal and number of it is read. Throws NewerJournal, and DiskError if the disk does not let it be read.
std::string damage_of(const std::filesystem::path& file);

/// Leaves a journal that can be opened at `file`. One that is damaged is kept beside it, as FILE.damaged-1 (2, …); a
/// new one takes its place with what can be read, row by row from both ends of each table: goals first, then numbers
/// and the records of what happened. Inputs and snapshots are left behind, since nobody can replay a part of them. The
/// new one's text kDamage says so, and its epoch is at least that of the mark (high_water_mark.hpp). It stands as
/// FILE.salvaged while the damaged one is moved; a start that finds it there goes on from there. Does nothing to one
/// that is whole. Throws as damage_of() does, with the damaged one in its place, and JournalError if there is no place
/// for the new one.
void salvage_if_damaged(const std::filesystem::path& file);

}  // namespace roci::exec::journal
