// A disk that takes nothing into files of some names: SQLite's own writes to them fail as on a full disk.
#pragma once

#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

namespace roci::exec::testing {

/// Refuses SQLite's writes to files for which `refused` holds, as long as it lives. There is one at a time.
class RefusedWrites {
 public:
  using Refused = std::function<bool(const std::filesystem::path&)>;

  explicit RefusedWrites(Refused refused) {
    refused_ = std::move(refused);
    set(&write);
  }
  ~RefusedWrites() { set(nullptr); }
  RefusedWrites(const RefusedWrites&) = delete;
  RefusedWrites& operator=(const RefusedWrites&) = delete;

 private:
  static ssize_t write(int descriptor, const void* bytes, size_t size, off_t at) {
    std::error_code unknown;
    const auto link = std::filesystem::path("/proc/self/fd") / std::to_string(descriptor);
    if (!refused_(std::filesystem::read_symlink(link, unknown))) return pwrite(descriptor, bytes, size, at);
    errno = ENOSPC;
    return -1;
  }
  static void set(ssize_t (*write)(int, const void*, size_t, off_t)) {
    sqlite3_vfs* const disk = sqlite3_vfs_find(nullptr);
    for (const char* name : {"pwrite", "pwrite64"})
      disk->xSetSystemCall(disk, name, reinterpret_cast<sqlite3_syscall_ptr>(write));
  }

  static inline Refused refused_;
};

/// Holds for a database whose log has something that the database itself has not: what is committed fits, and what
/// closing or a checkpoint would bring from the log into the file does not.
inline RefusedWrites::Refused checkpoints_of(const std::filesystem::path& database) {
  return [database](const std::filesystem::path& file) {
    std::error_code none;
    const auto log = std::filesystem::file_size(std::filesystem::path(database).concat("-wal"), none);
    return file == database && !none && log > 0;
  };
}

}  // namespace roci::exec::testing
