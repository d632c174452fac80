// These are the files that an SQLite database consists of, and the disk below them.
#pragma once

#include <filesystem>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::journal {

/// Lists the suffixes of the database's own file and of its write-ahead log, as SQLite names them.
inline constexpr const char* kDatabaseSuffixes[] = {"", "-wal", "-shm"};

void remove_database(const std::filesystem::path& file);
/// Removes the files of its write-ahead log alone.
void remove_database_logs(const std::filesystem::path& file);

/// Gives a file the name of another one, in whose place it stands from then on; with Durability::power the name is on
/// the disk then. Throws std::filesystem::filesystem_error if the file cannot be renamed, DiskError if the new name
/// cannot be written to the disk.
void put_in_place(const std::filesystem::path& unfinished, const std::filesystem::path& file, Durability);

/// Returns the first of FILE.damaged-1, FILE.damaged-2, … that is free, under which a damaged file is kept.
std::filesystem::path free_damaged_name(const std::filesystem::path& file);

/// Waits until a file, or the names in a folder, are on the disk. Throws DiskError.
void sync_path(const std::filesystem::path& path);

}  // namespace roci::exec::journal
