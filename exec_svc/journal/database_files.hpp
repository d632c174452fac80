// These are the files that an SQLite database consists of, and the disk below them.
#pragma once

#include <filesystem>

namespace roci::exec::journal {

/// Lists the suffixes of the database's own file and of its write-ahead log, as SQLite names them.
inline constexpr const char* kDatabaseSuffixes[] = {"", "-wal", "-shm"};

void remove_database(const std::filesystem::path& file);
/// Removes the files of its write-ahead log alone.
void remove_database_logs(const std::filesystem::path& file);

/// Waits until a file, or the names in a folder, are on the disk. Throws DiskError.
void sync_path(const std::filesystem::path& path);

}  // namespace roci::exec::journal
