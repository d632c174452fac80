// Plans as text, in the form of the International Planning Competition, one step per line, `;` for comments:
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

/// Same type as temporal::Duration.
using Microseconds = std::chrono::duration<std::int64_t, std::micro>;

struct PlanStep {
  Microseconds start{0};
  Atom action;  ///< names of objects, no variables
  std::optional<Microseconds> duration;
  SourceLocation where;
};

/// Rounds to whole microseconds. Throws ParseError: anything of another form, a negative time or duration,
/// one beyond 10^9 seconds. Names are not checked against a domain.
std::vector<PlanStep> parse_plan(std::string_view text, std::string_view file);

/// Three decimals, or up to six where three would lose something; in the given order.
std::string print_plan(const std::vector<PlanStep>& plan);
std::string print_seconds(Microseconds time);

}  // namespace roci::pddl
