// A comparison takes two traces line by line, after one renaming.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "exec_svc/trace/recorded_trace.hpp"
#include "exec_svc/trace/renaming.hpp"
#include "exec_svc/trace/trace_map.hpp"

namespace roci::exec::trace {

/// Holds the place of one differing line in Comparison::before and ::after, and nothing for the side that has
/// no such line.
struct Difference {
  std::optional<std::size_t> before;
  std::optional<std::size_t> after;
  bool operator==(const Difference&) const = default;
};

/// Holds what a comparison found, with the lines that it compared.
struct Comparison {
  std::vector<Line> before;             ///< lines of OLD under its new names
  std::vector<Line> after;              ///< lines of NEW without what was added
  std::vector<Difference> differences;  ///< in order of mission time, without the accepted ones
  std::size_t accepted = 0;             ///< number of differing lines that the map accepts
  Uses uses;                            ///< number of uses of each rule of the map

  bool equal() const { return differences.empty(); }
};

/// Lines are compared within each mission time, where the longest common row of lines counts as equal: a line
/// too many is one difference and moves no others. Both traces must hold the same kinds of lines
/// (RecordedTrace::decisions). `before` is OLD; its scenario, or that of `after`, chooses what is accepted.
Comparison compare(const RecordedTrace& before, const RecordedTrace& after, const TraceMap& map);

}  // namespace roci::exec::trace
