// This is about the first page of a journal's database: its header and its schema (SQLite, "Database File Format",
// section 1.3).
#pragma once

#include <filesystem>

namespace roci::exec::journal {

/// Replaces the first page of the `damaged` database by that of the `whole` one, with the damaged one's length. Both
/// must have the same page size, and the same tables made in the same order. Returns false, with nothing changed, if
/// the damaged file is shorter than two pages. Throws JournalError if a file cannot be read or written.
bool replace_first_page(const std::filesystem::path& damaged, const std::filesystem::path& whole);

}  // namespace roci::exec::journal
