// These counts tell what a process has waited for: a reaction that takes long waits for the disk, which has the
// journal, or for a processor.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace roci::bench {

/// Counts since the process began. Threads that wait side by side count one by one.
struct Waits {
  double disk_us = 0;       ///< in fsync and fdatasync
  double processor_us = 0;  ///< ready to run, while others had the processors
  Waits operator-(const Waits& other) const {
    return {disk_us - other.disk_us, processor_us - other.processor_us};
  }
};

/// Lets waits_of() read the disk waits of this process while it runs.
void publish_disk_waits();

void forget_disk_waits(pid_t process);

/// Returns the waits of a process of this user, of its disk if it publishes them.
Waits waits_of(pid_t process);

}  // namespace roci::bench
