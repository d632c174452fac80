// An answer is what an engine gives to a request.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/verdict.hpp"

namespace roci::planner::engine {

/// Names a goal that stands in the way of a plan, and what it lacks.
struct BlockingGoal {
  std::string issuer;
  std::string id;
  std::string timeline;  ///< that nothing brings about, or that runs out; empty: not known
  std::string reason;    ///< in words; empty: no plan brings it about, and nobody says why
  bool proved = true;    ///< false: an owner found no value that the goal needs, and more effort may find one
  friend bool operator==(const BlockingGoal&, const BlockingGoal&) = default;
};

/// Counts work; all but `bytes_per_state` is independent of the machine.
struct Statistics {
  std::uint64_t expanded = 0;
  std::uint64_t evaluated = 0;          ///< the simulated duration of a call counts these
  std::uint64_t function_tuples = 0;    ///< tuples that owners were asked for
  std::uint64_t function_requests = 0;  ///< batches in which they were asked
  std::uint64_t exact_values = 0;       ///< tuples that were to be exact
  double bytes_per_state = 0;
  bool from_remaining = false;  ///< whether the first plan was made of what remained of an earlier one
};

/// Holds a file by which a call can be made again without the service: N.pddl, N.values.
struct RecordFile {
  std::string ending;  ///< with its dot
  std::string text;
};

/// Holds the verdict of a call, with a plan if it is solved.
struct Answer {
  temporal::Verdict verdict = temporal::Verdict::crashed;
  std::string reason;  ///< in words, with file, line and column where the input is at fault
  /// Names, with unsolvable, the goals that are out of reach; none: all together are. With lacks_values those that
  /// are, as far as owners know.
  std::vector<BlockingGoal> blocking;
  /// With timeout: there is no plan unless an owner finds a value that it has not found (FunctionOutcome::unknown).
  bool lacks_values = false;
  std::optional<temporal::FlexiblePlan> plan;  ///< is there with solved alone
  Statistics statistics;
  std::vector<std::string> warnings;  ///< departures of the texts from their language, and how they were read
  std::vector<RecordFile> record;
};

/// Makes an answer without a plan.
Answer without_plan(temporal::Verdict verdict, std::string reason);

}  // namespace roci::planner::engine
