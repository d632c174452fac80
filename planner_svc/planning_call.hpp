// One planning call, whatever the engine: PDDL texts and a budget in, a verdict and one plan out. Plain
// values, no DDS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/function_source.hpp"

namespace roci::planner {

// In the order of Verdict in idl/planner.idl.
enum class PlanningVerdict {
  solved,
  unsolvable,
  timeout,
  out_of_memory,
  unsupported,
  function_unavailable,
  cancelled,
  invalid_input,
  crashed
};
const char* to_string(PlanningVerdict verdict);

struct PlanningCall {
  std::string engine;
  std::string domain_text;
  std::string problem_text;
  std::vector<pddl::PlanStep> remaining;  // what is left of an earlier plan
  std::uint64_t evaluations = 0;          // 0: no bound
  std::size_t memory_bytes = 0;           // 0: no bound
  std::function<bool()> out_of_time;      // empty: never
  std::function<bool()> cancelled;        // empty: never
};

struct PlanningStatistics {
  std::uint64_t expanded = 0;
  std::uint64_t evaluated = 0;
  double bytes_per_state = 0;
  bool from_remaining = false;  // the first plan was made of what remained
};

struct PlanningAnswer {
  PlanningVerdict verdict = PlanningVerdict::crashed;
  std::string reason;  // in words, with line and column where the input is at fault
  std::optional<temporal::FlexiblePlan> plan;
  PlanningStatistics statistics;
  pddl::FunctionTable function_values;  // every tuple asked for; one without a value stands as unreachable
};

// Never throws: what goes wrong inside is crashed with its reason. A plan that the independent validator
// rejects is not given out.
PlanningAnswer answer_call(const PlanningCall& call, FunctionSource& functions);

}  // namespace roci::planner
