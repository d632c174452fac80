// Decisions of the reactor stand as lines of text: the journal keeps them for people and for the trace, and a
// replay is compared with them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::journal {

/// Holds one decision of a step as text.
struct DecisionLine {
  std::string kind;  ///< "goal", "event", "step", "trace" (plans and commands), "call"
  std::string text;
  bool operator==(const DecisionLine&) const = default;
};

/// Returns them as they are journaled and sent. Lines of kind "trace" begin with the mission time in
/// microseconds.
std::vector<DecisionLine> decisions(temporal::Time now, const reactor::ReactorOutputs& out);

/// Returns whether a record of the journal is such a line; the other records were seen or measured.
bool is_decision(std::string_view kind, std::string_view text);

}  // namespace roci::exec::journal
