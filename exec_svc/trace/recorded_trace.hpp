// A recorded trace is what a run left as its trace: lines with their mission time, in the order in which
// they were written. Two runs are the same run when these lines are the same.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::exec::trace {

/// Reports a trace that cannot be read; what() names the file, the place in it and the remedy.
class TraceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds one line. Its text begins with the kind of the line, one word: `plan`, `command`, `ack` and
/// `observation` are lines of the trace, over which the hash of a run goes; `goal`, `event`, `step` and
/// `call` are the other decisions of the executive.
struct Line {
  temporal::Time time{0};
  std::string text;
  std::size_t number = 0;  ///< its place in the trace that it came from, from 1 on

  std::string_view kind() const { return std::string_view(text).substr(0, text.find(' ')); }
  bool operator==(const Line&) const = default;
};

/// Holds what is known of the run; it is empty or missing where nothing says it.
struct RecordedTrace {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  bool decisions = false;  ///< goals, events, steps and calls stand in it, too
  std::vector<Line> lines;

  bool operator==(const RecordedTrace&) const = default;
};

/// Returns whether a line of this kind is a decision that stands outside the trace.
bool is_decision_kind(std::string_view kind);

/// Returns the same trace without such lines, numbered anew.
RecordedTrace without_decisions(RecordedTrace trace);

}  // namespace roci::exec::trace
