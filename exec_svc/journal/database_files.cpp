#include "exec_svc/journal/database_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "core/durable/durable_file.hpp"

namespace roci::exec::journal {

namespace fs = std::filesystem;

void remove_database(const fs::path& file) {
  std::error_code ignored;
  for (const char* suffix : kDatabaseSuffixes) fs::remove(fs::path(file).concat(suffix), ignored);
}

void remove_database_logs(const fs::path& file) {
  std::error_code ignored;
  for (const char* suffix : {"-wal", "-shm"}) fs::remove(fs::path(file).concat(suffix), ignored);
}

void put_in_place(const fs::path& unfinished, const fs::path& file, Durability durability) {
  try {
    durable::put_in_place(
        unfinished, file,
        durability == Durability::power ? durable::Durability::power : durable::Durability::process);
  } catch (const fs::filesystem_error&) {
    throw;
  } catch (const std::system_error& error) {
    throw DiskError(error.what());
  }
}

fs::path free_damaged_name(const fs::path& file) {
  for (int number = 1;; ++number) {
    fs::path name = fs::path(file).concat(".damaged-" + std::to_string(number));
    if (!fs::exists(name)) return name;
  }
}

void sync_path(const fs::path& path) {
  const fs::path there = path.empty() ? fs::path(".") : path;
  const int descriptor = open(there.c_str(), O_RDONLY | O_CLOEXEC);
  const bool safe = descriptor >= 0 && fsync(descriptor) == 0;
  const std::string reason = std::strerror(errno);
  if (descriptor >= 0) close(descriptor);
  if (!safe) throw DiskError("cannot write " + there.string() + " to the disk: " + reason);
}

}  // namespace roci::exec::journal
