// What a call of the engine answers: verdict, reason, plan with its temporal network, statistics, function
// values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pddl/source.hpp"
#include "core/temporal/verdict.hpp"
#include "planner_svc/temporal_pddl/call/named_goal.hpp"
#include "planner_svc/temporal_pddl/call/statistics.hpp"
#include "planner_svc/temporal_pddl/extraction/plan.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"

namespace roci::planner::temporal_pddl {

/// The answer of plan(). The engine's verdicts are those up to invalid_input; `unsolvable` is proved: a goal
/// is unreachable even when relaxed, or the search space is exhausted.
struct Result {
  temporal::Verdict verdict = temporal::Verdict::invalid_input;
  std::string reason;  ///< what blocks, in words; empty with solved
  /// Names, with unsolvable or lacks_values, facts of the goal that are out of reach, as far as they are known one by
  /// one.
  std::vector<call::BlockedFact> blocked;
  /// With timeout: there is no plan unless an owner finds a value that it has not found (FunctionOutcome::unknown).
  bool lacks_values = false;
  std::optional<pddl::Diagnostic> where;  ///< of unsupported and invalid_input: the place in the model
  std::optional<extraction::Plan> plan;   ///< is there with solved alone
  call::Statistics statistics;
  std::vector<engine::FunctionUse> functions;  ///< every tuple that was asked for
  /// "FILE:LINE:COLUMN: warning: …": what is legal and yet hardly meant, as a number that has no value.
  std::vector<std::string> warnings;
};

}  // namespace roci::planner::temporal_pddl
