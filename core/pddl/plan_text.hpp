// Plans stand as text in the form of the International Planning Competition, one step per line, where `;`
// begins a comment:
//   0.001: (drive a b) [12.5]      start in seconds: (action object …) [duration in seconds]
//   13.5: (beep)                   an instantaneous action
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Names the same type as temporal::Duration.
using Microseconds = std::chrono::duration<std::int64_t, std::micro>;

/// Holds one step of a plan; an instantaneous one may have no duration.
struct PlanStep {
  Microseconds start{0};
  Atom action;  ///< names of objects, no variables
  std::optional<Microseconds> duration;
  SourceLocation where;
};

/// Reads a plan and rounds its times to whole microseconds. Throws ParseError for anything of another form, a
/// negative time or duration, or one beyond 10^9 seconds. Names are not checked against a domain.
std::vector<PlanStep> parse_plan(std::string_view text, std::string_view file);

/// Prints the steps in the given order, with three decimals, or up to six where three would lose something.
std::string print_plan(const std::vector<PlanStep>& plan);
std::string print_seconds(Microseconds time);

}  // namespace roci::pddl
