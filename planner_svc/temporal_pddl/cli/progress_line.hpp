// The line that tells on a terminal what roci-plan is doing.
#pragma once

#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <string>

#include "planner_svc/temporal_pddl/call/progress.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Returns "12 s  searching: lookahead  1234 evaluated  best 45.000 s  87 MB", cut to the columns.
std::string progress_text(const call::Progress& progress, double seconds, std::size_t megabytes,
                          std::size_t columns);

/// Writes the line over itself four times a second, and takes it away in the end.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// `columns`: of the terminal. The stream must outlive the line.
  ProgressLine(std::ostream& out, Clock::time_point begin, std::size_t columns)
      : out_(out), begin_(begin), columns_(columns) {}
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const call::Progress& progress);

 private:
  std::ostream& out_;
  Clock::time_point begin_;
  std::size_t columns_;
  Clock::time_point next_ = begin_ + std::chrono::milliseconds(250);
  bool shown_ = false;
};

}  // namespace roci::planner::temporal_pddl::cli
