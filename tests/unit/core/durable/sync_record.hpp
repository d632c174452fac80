// Records what the code under test waits for on the disk: this fsync(2) stands before the C library's. One source of a
// test program includes it.
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace roci::durable {

/// The names of the files and folders that were synced, in this order.
inline std::vector<std::string>& synced() {
  static std::vector<std::string> names;
  return names;
}

}  // namespace roci::durable

extern "C" int fsync(int descriptor) {
  std::error_code unknown;
  const auto link = std::filesystem::path("/proc/self/fd") / std::to_string(descriptor);
  roci::durable::synced().push_back(std::filesystem::read_symlink(link, unknown).string());
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}
