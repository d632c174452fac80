/// What the reactor decided in one step, as lines of text: what the journal keeps for people and for the
/// trace, and what a replay is compared with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::journal {

struct DecisionLine {
  std::string kind;  ///< "goal", "event", "step", "trace" (plans and commands), "call"
  std::string text;
  bool operator==(const DecisionLine&) const = default;
};

/// Returns them as they are journaled and sent. Lines of kind "trace" begin with the mission time in
/// microseconds.
std::vector<DecisionLine> decisions(temporal::Time now, const reactor::ReactorOutputs& out);

/// Whether a record of the journal is such a line; the other records were seen or measured.
bool is_decision(std::string_view kind, std::string_view text);

}  // namespace roci::exec::journal
