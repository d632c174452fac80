// The ground model is what instantiation leaves: it speaks of atoms of the reachability analysis, before
// facts are numbered.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"
#include "planner_svc/temporal_pddl/task/short_list.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

/// Holds an atom or its negation.
struct GroundLiteral {
  GroundLiteral() = default;
  constexpr GroundLiteral(std::uint32_t of, bool is_negated) : atom(of & 0x7fffffffu), negated(is_negated) {}

  std::uint32_t atom : 31 = 0;
  bool negated : 1 = false;

  /// Orders by atom; a negation follows its atom.
  constexpr std::strong_ordering operator<=>(const GroundLiteral& other) const {
    return (2 * std::uint64_t{atom} + negated) <=> (2 * std::uint64_t{other.atom} + other.negated);
  }
  constexpr bool operator==(const GroundLiteral& other) const {
    return atom == other.atom && negated == other.negated;
  }
};

/// Holds a conjunction, all of which must hold. Both lists are sorted and without duplicates.
struct Conjunction {
  task::ShortList<GroundLiteral> literals;
  task::RareList<task::NumericCondition> comparisons;

  bool empty() const { return literals.empty() && comparisons.empty(); }
  auto operator<=>(const Conjunction&) const = default;
};

/// Lists alternatives: without any it is false, and with an empty one it is true.
using Disjunction = std::vector<Conjunction>;

/// Holds an entry of a read set: what a condition at the start or at the end of an action reads without
/// asking for it. These are parts that what never changes decides, alternatives that were not chosen, and
/// conditions of effects that do not happen. Nobody may change it within ε of that moment either (R6; Fox and
/// Long 2003, definition 12).
struct ReadVariable {
  std::uint32_t index = 0;  ///< the index of an atom or a number
  bool is_number = false;
  bool at_end = false;
  auto operator<=>(const ReadVariable&) const = default;
};

/// Holds what happens at one end of an action or at a timed literal.
struct GroundEffects {
  task::ShortList<std::uint32_t> adds, deletes;  ///< atoms, sorted; no atom is in both
  task::RareList<task::NumericEffect> numeric;
  /// Holds those of `adds` that are also deleted, which is seen by what happens at that moment.
  task::RareList<std::uint32_t> resets;
  auto operator<=>(const GroundEffects&) const = default;
};

/// Says when the start and the end may happen; the whole action must lie in one of `span`. See
/// simplification/timed_windows.hpp.
struct ActionWindows {
  task::TimeWindows start = task::any_time(), end = task::any_time(), span = task::any_time();
};

/// Describes an action instance with one choice among the alternatives of its conditions. There may be a million of
/// them: an action of a few conditions and effects takes this struct and nothing on the heap.
struct GroundAction {
  task::SchemaId schema;
  std::uint32_t read_sets = 0;  ///< the index of a list of GroundModel::read_sets
  task::ShortList<task::ObjectId> arguments;
  temporal::Duration min_duration{0};
  temporal::Duration max_duration = temporal::no_bound;
  task::RareList<task::DurationRule> duration_rules;
  Conjunction at_start, over_all, at_end;
  GroundEffects start_effects, end_effects;
  std::shared_ptr<const ActionWindows> windows;  ///< is null where any time will do
  bool durative = true;
};

/// Returns what the lists of an action take besides the action itself.
std::size_t heap_bytes(const GroundAction& action);

/// Holds a rule: wherever the body holds, so does the head, a derived atom.
struct GroundRule {
  GroundLiteral head;
  int layer = 0;
  Conjunction body;
};

/// Holds what happens by itself at one time.
struct TimedChange {
  temporal::Duration time{0};
  GroundEffects effects;
};

/// Describes an action instance that none of its windows has room for.
struct WindowMisfit {
  task::SchemaId schema;
  std::vector<task::ObjectId> arguments;
  std::vector<std::uint32_t> adds;  ///< atoms
  temporal::Duration duration{0};   ///< is the least that the action takes
  temporal::Duration window{0};     ///< the longest
};

/// Describes an action instance that can never run; see grounding/impossible_actions.hpp.
struct ImpossibleAction {
  task::SchemaId schema;
  std::vector<task::ObjectId> arguments;
  std::vector<std::uint32_t> adds;      ///< atoms
  std::optional<GroundLiteral> broken;  ///< of its `over all`, by its own start
  temporal::Duration longest{0};        ///< without `broken`: the duration, which is less than ε
};

/// Holds the whole problem over atoms and numbers, which are named by their indices.
struct GroundModel {
  lifted::TupleTable atoms;
  std::vector<bool> derived;   ///< is indexed by atom
  lifted::TupleTable numbers;  ///< fluents that change; their index is the NumberId
  task::ExpressionPool expressions;
  std::vector<std::uint32_t> initial_atoms;
  std::vector<double> initial_numbers;  ///< NaN: undefined
  std::vector<GroundAction> actions;
  /// Holds sorted lists, of which the first is empty. Neighbours with equal read sets share one.
  std::vector<std::vector<ReadVariable>> read_sets = std::vector<std::vector<ReadVariable>>(1);
  std::vector<WindowMisfit> window_misfits;          ///< taken out of `actions`
  std::vector<ImpossibleAction> impossible_actions;  ///< taken out of `actions`
  std::vector<GroundRule> rules;                     ///< stand in order of layers
  std::vector<TimedChange> timed;                    ///< stand in order of time, one per instant
  Disjunction goal;
  task::Metric metric;
  /// It is indexed by number: nothing else asks for it, and it is never assigned.
  std::vector<bool> only_metric_asks;
  std::vector<std::string> unreachable_goals;  ///< are texts, if `goal` has no alternative from the beginning

  const std::vector<ReadVariable>& read_set_of(const GroundAction& action) const {
    return read_sets[action.read_sets];
  }
};

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
