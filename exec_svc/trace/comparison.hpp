// A comparison takes two traces line by line, after one renaming.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "exec_svc/trace/recorded_trace.hpp"
#include "exec_svc/trace/renaming.hpp"
#include "exec_svc/trace/trace_map.hpp"

namespace roci::exec::trace {

/// Is one differing line: it holds where it stands in Comparison::before and ::after, and nothing on the side
/// that has no such line.
struct Difference {
  std::optional<std::size_t> before;
  std::optional<std::size_t> after;
  bool operator==(const Difference&) const = default;
};

/// Holds what a comparison found, with the lines that it compared.
struct Comparison {
  std::vector<Line> before;             ///< Are those of OLD under its new names.
  std::vector<Line> after;              ///< Are those of NEW without what was added.
  std::vector<Difference> differences;  ///< Stand in order of mission time, without the accepted ones.
  std::size_t accepted = 0;             ///< Counts differing lines that the map accepts.
  Uses uses;                            ///< Counts those of the map's rules.

  bool equal() const { return differences.empty(); }
};

/// Lines are compared within each mission time, where the longest common row of lines counts as equal: a line
/// too many is one difference and moves no others. Both traces must hold the same kinds of lines
/// (RecordedTrace::decisions). `before` is OLD; its scenario, or that of `after`, chooses what is accepted.
Comparison compare(const RecordedTrace& before, const RecordedTrace& after, const TraceMap& map);

}  // namespace roci::exec::trace
