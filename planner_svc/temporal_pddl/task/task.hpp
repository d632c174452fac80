// The ground planning task is ⟨P, V, A, I, TILs, G⟩ of Stellar section 2.1 as flat, immutable tables.
//
// Each durative action is split into two snap actions, its start and its end (R10). Static facts and constant
// fluents are gone; a negative condition is a condition on a fact of its own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "planner_svc/temporal_pddl/task/derived_facts.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"
#include "planner_svc/temporal_pddl/task/state_layout.hpp"
#include "planner_svc/temporal_pddl/task/time_windows.hpp"

namespace roci::planner::temporal_pddl::task {

/// Names what temporal constraints are about (v of R22, R23): a fact or a number.
using VariableId = Id<struct VariableTag>;

/// Says what a snap action is.
enum class SnapKind : std::uint8_t {
  start,
  end,
  instant,
  timed_literal,
  /// Belongs to no plan; heuristics see by it how a derived fact or its negation comes to hold.
  derivation,
};

/// Describes an instant at which a state changes (snap action, R10).
struct Snap {
  SnapKind kind = SnapKind::start;
  ActionId action;  ///< is none for timed_literal and derivation
};

/// Bounds ?duration (in seconds) by an expression that is evaluated in the state before the start or before
/// the end.
struct DurationRule {
  ExpressionId bound;
  bool from_below = true;  ///< ?duration ≥ bound
  bool from_above = true;  ///< ?duration ≤ bound; with both, they are equal
  bool at_end = false;
};

/// Describes a ground action; its snap actions carry conditions and effects.
struct Action {
  SchemaId schema;
  SnapId start;
  SnapId end;                          ///< equals start for a plain PDDL action
  temporal::Duration min_duration{0};  ///< the constant bounds, which duration rules may narrow
  temporal::Duration max_duration = temporal::no_bound;
  bool compression_safe = false;  ///< see grounding/invariants/compression_safety.hpp

  bool instantaneous() const { return start == end; }
};

/// Describes a timed literal that happens at its time by itself.
struct TimedStep {
  SnapId snap;
  temporal::Duration time{0};
};

/// Holds one alternative of the goal, all of which must hold.
struct Goal {
  std::vector<FactId> facts;
  std::vector<NumericCondition> comparisons;
};

/// What plans are judged by (:metric): the smaller it is the better; the duration in it is that of the plan.
struct Metric {
  LinearExpression expression{{}, 1, 0};  ///< is evaluated over the numbers after the last step
  bool maximized = false;                 ///< whether the problem wants the negation to be large

  /// Returns whether nothing counts but the time of the last step.
  bool only_time() const { return expression.terms.empty() && expression.duration_weight > 0; }
};

/// Names a ground atom or its negation in reports.
struct FactName {
  std::uint32_t atom = 0;  ///< index of Task::atom_arguments
  PredicateId predicate;
  bool negated = false;
};

/// Holds the whole ground task; nothing changes it once it is built.
struct Task {
  // ---- Names
  std::vector<std::string> objects, predicates, functions, schemas;
  IdVector<FactId, FactName> fact_names;
  FlatLists<ObjectId> atom_arguments;
  FlatLists<ObjectId> action_arguments;  ///< are by ActionId the parameters of the schema
  std::vector<std::string> number_names;

  // ---- Snap actions, by SnapId
  IdVector<SnapId, Snap> snaps;
  FlatLists<FactId> conditions;              ///< pre⊢ or pre⊣
  FlatLists<NumericCondition> comparisons;   ///< belong to pre⊢ or pre⊣, too
  FlatLists<FactId> adds, deletes;           ///< are applied deletes first, then adds
  FlatLists<NumericEffect> numeric_effects;  ///< are all evaluated in the state before
  FlatLists<VariableId> reads, writes;       ///< are what orderings go by (R22, R23)
  /// They say when the snap action may happen (R33); an empty list allows any time.
  FlatLists<TimeWindow> windows;

  // ---- Actions, by ActionId
  IdVector<ActionId, Action> actions;
  FlatLists<FactId> invariants;  ///< pre↔
  FlatLists<NumericCondition> numeric_invariants;
  FlatLists<VariableId> invariant_reads;
  /// One of these must contain the whole action; an empty list allows any time.
  FlatLists<TimeWindow> span_windows;
  FlatLists<DurationRule> duration_rules;
  FlatLists<VariableId> derived_invariant_reads;  ///< is what the derived facts among the invariants hang on
  /// These facts must be false before the start; see Action::compression_safe.
  FlatLists<FactId> absent_for_compression;

  // ---- The rest
  /// Stand in order of time; those that windows replace are not among them.
  std::vector<TimedStep> timed_steps;
  std::vector<Goal> goals;                   ///< alternatives
  FlatLists<VariableId> derived_goal_reads;  ///< is what the derived facts in each goal hang on
  IdVector<FactId, bool> is_derived;
  DerivedFacts derived;
  Metric metric;
  ExpressionPool expressions;
  StateLayout layout;
  std::vector<Word> initial_state;

  /// Returns whether it matters when a plan happens, and not only in which order. Else every plan may begin
  /// later as a whole.
  bool has_absolute_times() const;

  /// Returns the other end of the same durative action, or none.
  SnapId other_end(SnapId snap) const;

  /// Returns the allocated bytes; what does not grow with the facts and actions is left out.
  std::size_t bytes() const;

  std::size_t variables() const { return fact_names.size() + number_names.size(); }
  VariableId variable(FactId fact) const { return VariableId(fact.index()); }
  VariableId variable(NumberId number) const { return VariableId(fact_names.size() + number.index()); }
};

/// Prints as "(at rover w1)" or "(not (open door))".
std::string name(const Task& task, FactId fact);
/// Prints as "(drive rover w1 w2)".
std::string name(const Task& task, ActionId action);

}  // namespace roci::planner::temporal_pddl::task
