// What a planning call answers: verdict, reason, plan with its temporal network, statistics, function values
// used.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pddl/source.hpp"
#include "planner_svc/function_source.hpp"

namespace roci::planner::temporal_pddl {

// Integer microseconds: sums of durations are exact.
using Duration = std::chrono::duration<std::int64_t, std::micro>;

// Stands for "no upper bound".
inline constexpr Duration kUnbounded = Duration::max();

// One edge of the Simple Temporal Network: lower ≤ t(to) − t(from) ≤ upper.
enum class ConstraintKind {
  ordering,  // R22, R23: lower is 0 or ε, upper is kUnbounded
  duration,  // R24: from the start to the end of one activity
  window,    // R32, R33: from the origin; a timed initial literal bounds the time point
};

struct TimeConstraint {
  std::size_t from = 0;  // indices of Network::points
  std::size_t to = 0;
  Duration lower{0};
  Duration upper = kUnbounded;
  ConstraintKind kind = ConstraintKind::ordering;
};

enum class TimePointKind { origin, start, end, timed_literal };

// [earliest, latest] are shortest paths of the network from and to the origin (R48): every value between them
// is taken in some schedule that obeys all constraints.
struct TimePoint {
  TimePointKind kind = TimePointKind::origin;
  std::size_t activity = 0;  // of start and end: index of Plan::activities
  Duration earliest{0};
  Duration latest = kUnbounded;
};

struct Network {
  std::vector<TimePoint> points;  // [0] is the origin, time 0 of the problem
  std::vector<TimeConstraint> constraints;
};

// A condition with objects in place of parameters, as PDDL text; values of constant fluents and of external
// functions stand in it as numbers. A disjunction is one formula.
struct GroundCondition {
  enum class Kind { fact, negated_fact, comparison, formula };
  Kind kind = Kind::fact;
  std::string text;  // "(at w1)" also for negated_fact, "(>= (battery) 30)"
};

// An effect as PDDL text: "(at w2)", "(not (at w1))", "(decrease (battery) 12.5)".
struct GroundEffect {
  std::string text;
};

struct Activity {
  std::string name;
  std::vector<std::string> arguments;
  bool durative = true;         // a plain PDDL action has one time point: start_point == end_point
  std::size_t start_point = 0;  // indices of Network::points
  std::size_t end_point = 0;
  Duration start{0};  // in the schedule of earliest times
  Duration end{0};
  Duration min_duration{0};
  Duration max_duration = kUnbounded;
  std::vector<GroundCondition> at_start, over_all, at_end;
  std::vector<GroundEffect> start_effects, end_effects;
};

struct Plan {
  std::vector<Activity> activities;  // by start time
  Network network;
  Duration makespan{0};
  double metric = 0;  // as the problem states it; without a metric, the makespan in seconds
};

enum class Verdict {
  solved,
  unsolvable,            // proved: a goal is unreachable even when relaxed, or the search space is exhausted
  timeout,               // Budget::out_of_time said so, or the work is spent
  out_of_memory,         // Budget::memory_bytes is spent
  unsupported,           // the model uses what the engine does not take: see where
  function_unavailable,  // an external function has no usable value for a tuple
  cancelled,
  invalid_input,  // the model contradicts itself: see where
};

// "solved", "unsolvable", "timeout", "out_of_memory", "unsupported", "function_unavailable", "cancelled",
// "invalid_input".
const char* to_string(Verdict verdict);

struct Statistics {
  std::size_t facts = 0;
  std::size_t variables = 0;  // finite-domain variables of the packed state
  std::size_t numeric_variables = 0;
  std::size_t actions = 0;    // ground
  std::size_t generated = 0;  // successors put into the open list
  std::size_t evaluated = 0;  // heuristic evaluations
  std::size_t expanded = 0;
  std::size_t temporally_inconsistent = 0;  // successors that the network pruned (R25)
  std::size_t dominated = 0;                // successors that the dominance check pruned
  std::size_t hopeless = 0;                 // successors that resources do not suffice for, or with dead pairs
  double bytes_per_state =
      0;  // mean over stored states: packed state, numbers, parent, operator, constraints
  bool from_remaining = false;  // the first plan was made of what remained of an earlier one
  std::size_t peak_bytes = 0;   // as the engine counts its own memory
};

struct FunctionUse {
  FunctionCall call;
  FunctionValue answer;
};

struct Result {
  Verdict verdict = Verdict::invalid_input;
  std::string reason;                     // what blocks, in words; empty with solved
  std::optional<pddl::Diagnostic> where;  // unsupported and invalid_input: the place in the model
  std::optional<Plan> plan;               // with solved
  Statistics statistics;
  std::vector<FunctionUse> functions;  // every tuple that was asked for
};

}  // namespace roci::planner::temporal_pddl
