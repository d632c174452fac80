// The ground planning task: ⟨P, V, A, I, TILs, G⟩ of Stellar section 2.1 as flat, immutable tables.
//
// Each durative action is split into two snap actions, its start and its end (R10). Static facts and constant
// fluents are gone; a negative condition is a condition on a fact of its own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/task/derived_facts.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"
#include "planner_svc/temporal_pddl/task/state_layout.hpp"
#include "planner_svc/temporal_pddl/task/time_windows.hpp"

namespace roci::planner::temporal_pddl {

// What temporal constraints are about (v of R22, R23): a fact or a number.
using VariableId = Id<struct VariableTag>;

enum class SnapKind : std::uint8_t {
  start,
  end,
  instant,
  timed_literal,
  derivation,  // no step of a plan: how a derived fact or its negation comes to hold, for heuristics
};

struct Snap {
  SnapKind kind = SnapKind::start;
  ActionId action;  // none for timed_literal and derivation
};

// ?duration OP expression (in seconds), evaluated in the state before the start or before the end.
struct DurationRule {
  pddl::ComparisonOperator op = pddl::ComparisonOperator::equal;
  ExpressionId bound;
  pddl::TimePoint at = pddl::TimePoint::start;
};

struct Action {
  SchemaId schema;
  SnapId start;
  SnapId end;                // == start: a plain PDDL action
  Duration min_duration{0};  // constant bounds; DurationRules may narrow them
  Duration max_duration = kUnbounded;
  bool compression_safe = false;  // see grounding/compression.hpp

  bool instantaneous() const { return start == end; }
};

struct TimedStep {
  SnapId snap;
  Duration time{0};
};

struct Goal {
  std::vector<FactId> facts;
  std::vector<NumericCondition> comparisons;
};

// What plans are judged by (:metric). The smaller the better; the duration in it is the plan's.
struct Metric {
  LinearExpression expression{{}, 1, 0};  // over the numbers after the last step
  bool maximized = false;                 // the problem wants the negation to be large

  // The time of the last step and nothing else counts.
  bool only_time() const { return expression.terms.empty() && expression.duration_weight > 0; }
};

// A ground atom, for names in reports.
struct FactName {
  std::uint32_t atom = 0;  // index of Task::atom_arguments
  PredicateId predicate;
  bool negated = false;
};

struct Task {
  // ---- Names
  std::vector<std::string> objects, predicates, functions, schemas;
  IdVector<FactId, FactName> fact_names;
  FlatLists<ObjectId> atom_arguments;
  FlatLists<ObjectId> action_arguments;  // by ActionId, the parameters of the schema
  std::vector<std::string> number_names;

  // ---- Snap actions, by SnapId
  IdVector<SnapId, Snap> snaps;
  FlatLists<FactId> conditions;              // pre⊢ or pre⊣
  FlatLists<NumericCondition> comparisons;   // likewise
  FlatLists<FactId> adds, deletes;           // deletes first, then adds
  FlatLists<NumericEffect> numeric_effects;  // all evaluated in the state before
  FlatLists<VariableId> reads, writes;       // for R22, R23
  FlatLists<TimeWindow> windows;             // when it may happen (R33); none: any time

  // ---- Actions, by ActionId
  IdVector<ActionId, Action> actions;
  FlatLists<FactId> invariants;  // pre↔
  FlatLists<NumericCondition> numeric_invariants;
  FlatLists<VariableId> invariant_reads;
  FlatLists<TimeWindow> span_windows;  // one of them must contain the whole action; none: any time
  FlatLists<DurationRule> duration_rules;
  FlatLists<VariableId> derived_invariant_reads;  // what derived facts among the invariants hang on
  FlatLists<FactId> absent_for_compression;  // must be false before the start; see Action::compression_safe

  // ---- The rest
  std::vector<TimedStep> timed_steps;        // by time; those that windows replace are not among them
  std::vector<Goal> goals;                   // alternatives
  FlatLists<VariableId> derived_goal_reads;  // by goal: what derived facts in it hang on
  IdVector<FactId, bool> is_derived;
  DerivedFacts derived;
  Metric metric;
  ExpressionPool expressions;
  StateLayout layout;
  std::vector<Word> initial_state;

  // Does it matter when a plan happens, not only in which order? Else every plan may begin later as a whole.
  bool has_absolute_times() const;

  // Of the same durative action; none: there is none.
  SnapId other_end(SnapId snap) const;

  // Allocated; what does not grow with the facts and actions is left out.
  std::size_t bytes() const;

  std::size_t variables() const { return fact_names.size() + number_names.size(); }
  VariableId variable(FactId fact) const { return VariableId(fact.index()); }
  VariableId variable(NumberId number) const { return VariableId(fact_names.size() + number.index()); }
};

// "(at rover w1)", "(not (open door))"
std::string name(const Task& task, FactId fact);
// "(drive rover w1 w2)"
std::string name(const Task& task, ActionId action);

}  // namespace roci::planner::temporal_pddl
