/// The first page of a journal's database: its header and its schema (SQLite, "Database File Format", section 1.3).
#pragma once

#include <filesystem>

namespace roci::exec::journal {

/// Puts the first page of one database in the place of another one's that is damaged there, with the other's length.
/// Both must have the same tables, made in the same order. False: they have pages of different sizes, or the other one
/// is no row of pages. Throws JournalError if a file cannot be read or written.
bool replace_first_page(const std::filesystem::path& damaged, const std::filesystem::path& whole);

}  // namespace roci::exec::journal
