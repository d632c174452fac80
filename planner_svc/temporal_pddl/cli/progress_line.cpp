#include "planner_svc/temporal_pddl/cli/progress_line.hpp"

#include <unistd.h>

#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace roci::planner::temporal_pddl::cli {

namespace {

// What the process holds in memory now; 0 where the system does not tell.
std::size_t resident_megabytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return file ? resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) >> 20 : 0;
}

}  // namespace

std::string progress_text(const call::Progress& progress, double seconds, std::size_t megabytes,
                          std::size_t columns) {
  std::ostringstream text;
  text << static_cast<long>(seconds) << " s  " << progress.phase;
  if (progress.evaluated > 0) text << "  " << progress.evaluated << " evaluated";
  if (progress.has_plan) {
    const double makespan = std::chrono::duration<double>(progress.makespan).count();
    text << "  best plan " << std::fixed << std::setprecision(3) << makespan << " s";
    if (progress.metric != makespan) text << ", metric " << std::defaultfloat << progress.metric;
  }
  if (megabytes > 0) text << "  " << megabytes << " MB";
  return text.str().substr(0, columns);
}

ProgressLine::~ProgressLine() {
  if (shown_) out_ << "\r\x1b[K" << std::flush;
}

void ProgressLine::show(const call::Progress& progress) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(250);
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  out_ << "\r\x1b[K" << progress_text(progress, seconds, resident_megabytes(), columns_ - 1) << std::flush;
}

}  // namespace roci::planner::temporal_pddl::cli
