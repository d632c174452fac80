// The engine as planner_svc calls it: PDDL texts and a budget in, a verdict and one checked plan out. All of
// it is plain values, without DDS.
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
#include "core/temporal/verdict.hpp"
#include "planner_svc/function_source.hpp"

namespace roci::planner::temporal_pddl::adapter {

struct PlanningCall {
  std::string engine;
  std::string domain_text;
  std::string problem_text;
  std::vector<pddl::PlanStep> remaining;  ///< what is left of an earlier plan
  std::uint64_t evaluations = 0;          ///< is no bound if 0
  std::size_t memory_bytes = 0;           ///< 0: no bound
  std::function<bool()> out_of_time;      ///< never says so if empty
  std::function<bool()> cancelled;        ///< empty: never
};

struct PlanningStatistics {
  std::uint64_t expanded = 0;
  std::uint64_t evaluated = 0;
  double bytes_per_state = 0;
  bool from_remaining = false;  ///< whether the first plan was made of what remained
};

struct PlanningAnswer {
  temporal::Verdict verdict = temporal::Verdict::crashed;
  std::string reason;  ///< in words, with line and column where the input is at fault
  std::optional<temporal::FlexiblePlan> plan;
  PlanningStatistics statistics;
  /// Holds every tuple that was asked for; one without a value stands as unreachable.
  pddl::FunctionTable function_values;
};

/// Answers a call and never throws: what goes wrong inside is `crashed` with its reason. A plan that the
/// independent validator rejects is not given out.
PlanningAnswer answer_call(const PlanningCall& call, FunctionSource& functions);

}  // namespace roci::planner::temporal_pddl::adapter
