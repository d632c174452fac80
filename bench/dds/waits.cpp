#include "bench/dds/waits.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

namespace roci::bench {
namespace {

namespace fs = std::filesystem;

using Count = std::atomic<std::int64_t>;

Count own_count;
Count* disk_ns = &own_count;

fs::path file_of(pid_t process) { return "/dev/shm/roci-bench-waits-" + std::to_string(process); }

int synced(long call, int descriptor) {
  const auto begun = std::chrono::steady_clock::now();
  const int result = static_cast<int>(syscall(call, descriptor));
  *disk_ns += std::chrono::nanoseconds(std::chrono::steady_clock::now() - begun).count();
  return result;
}

}  // namespace

void publish_disk_waits() {
  const fs::path file = file_of(getpid());
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0 || ftruncate(descriptor, sizeof(Count)) != 0)
    throw std::system_error(errno, std::generic_category(), file.string());
  void* const shared = mmap(nullptr, sizeof(Count), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  ::close(descriptor);
  if (shared == MAP_FAILED) throw std::system_error(errno, std::generic_category(), file.string());
  disk_ns = static_cast<Count*>(shared);
}

void forget_disk_waits(pid_t process) {
  std::error_code gone;
  fs::remove(file_of(process), gone);
}

Waits waits_of(pid_t process) {
  Waits out;
  std::int64_t disk = 0;
  std::ifstream(file_of(process), std::ios::binary).read(reinterpret_cast<char*>(&disk), sizeof disk);
  out.disk_us = static_cast<double>(disk) / 1e3;
  std::error_code gone;
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
    double ran = 0, waited = 0;
    std::ifstream(thread.path() / "schedstat") >> ran >> waited;
    out.processor_us += waited / 1e3;
  }
  return out;
}

}  // namespace roci::bench

// SQLite's calls come here, as those of all libraries of this program do.
extern "C" int fsync(int descriptor) { return roci::bench::synced(SYS_fsync, descriptor); }
extern "C" int fdatasync(int descriptor) { return roci::bench::synced(SYS_fdatasync, descriptor); }
