// This file reads what the kernel says of a process, from /proc.
#pragma once

#include <sys/types.h>

#include <vector>

namespace roci::bench::house {

/// Holds what one process, or several, take.
struct ProcessFigures {
  double pss_mb = 0;  ///< Is the proportional set size: pages that processes share count by shares.
  double cpu_s = 0;   ///< Counts user and system time since its start.
  int threads = 0;
};

/// Returns zeros for a process that is gone.
ProcessFigures figures_of(pid_t process);

/// Returns the sums over processes.
ProcessFigures figures_of(const std::vector<pid_t>& processes);

}  // namespace roci::bench::house
