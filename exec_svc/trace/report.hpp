// The report tells people what a comparison found.
#pragma once

#include <cstddef>
#include <string>

#include "exec_svc/trace/comparison.hpp"

namespace roci::exec::trace {

/// Says how much of the differences is shown.
struct ReportOptions {
  std::size_t shown = 1;    ///< number of differences that are shown, the first ones
  std::size_t context = 3;  ///< number of lines of each side before a difference
  std::size_t width = 200;  ///< bytes of a shown line; a longer one is cut to the part around the difference
};

/// Returns one line on the whole, such as "different: 3 lines of 812 (2 more accepted)".
std::string verdict(const Comparison& comparison);

/// Returns the first differences, each with the lines before it: `-` stands before lines of OLD, `+` before
/// those of NEW, with their numbers in their traces. The text is empty when there is none.
std::string differences(const Comparison& comparison, const ReportOptions& options = {});

/// Returns a line for each rule of the map that `uses` has not; it looks at accepted differences alone, or
/// also at new names, rewrites and additions. The text is empty when each was of use.
std::string useless_rules(const TraceMap& map, const Uses& uses, const std::string& scenario, bool all);

}  // namespace roci::exec::trace
