// Ground actions as instantiation leaves them: over atoms of the reachability analysis, before facts are
// numbered.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// An atom or its negation.
struct GroundLiteral {
  std::uint32_t atom = 0;
  bool negated = false;
  auto operator<=>(const GroundLiteral&) const = default;
};

// All of it must hold. Both lists are sorted and without duplicates.
struct Conjunction {
  std::vector<GroundLiteral> literals;
  std::vector<NumericCondition> comparisons;

  bool empty() const { return literals.empty() && comparisons.empty(); }
  auto operator<=>(const Conjunction&) const = default;
};

// Alternatives; none: false; an empty one: true.
using Disjunction = std::vector<Conjunction>;

// What a condition at the start or at the end of an action mentions without asking for it: parts that what
// never changes decides, alternatives that were not chosen, conditions of effects that do not happen. Nobody
// may change it within ε of that moment either (R6; Fox and Long 2003, definition 12).
struct Mention {
  std::uint32_t index = 0;  // of an atom or a number
  bool is_number = false;
  bool at_end = false;
  auto operator<=>(const Mention&) const = default;
};

struct GroundEffects {
  std::vector<std::uint32_t> adds, deletes;  // atoms, sorted; no atom is in both
  std::vector<NumericEffect> numeric;
  std::vector<std::uint32_t> resets;  // of adds: also deleted, which is seen by what happens at that moment
  auto operator<=>(const GroundEffects&) const = default;
};

// When the start and the end may happen; the whole action must lie in one of `span`. See timed_windows.hpp.
struct ActionWindows {
  TimeWindows start = any_time(), end = any_time(), span = any_time();
};

struct GroundAction {
  SchemaId schema;
  std::vector<ObjectId> arguments;
  bool durative = true;
  std::uint32_t mentions = 0;  // a list of GroundModel::mentions
  Duration min_duration{0};
  Duration max_duration = kUnbounded;
  std::vector<DurationRule> duration_rules;
  Conjunction at_start, over_all, at_end;
  GroundEffects start_effects, end_effects;
  std::shared_ptr<const ActionWindows> windows;  // none: any time
};

// Wherever the body holds, so does the head, a derived atom.
struct GroundRule {
  GroundLiteral head;
  int layer = 0;
  Conjunction body;
};

struct TimedChange {
  Duration time{0};
  GroundEffects effects;
};

// An action instance that none of its windows has room for.
struct TooLong {
  SchemaId schema;
  std::vector<ObjectId> arguments;
  std::vector<std::uint32_t> adds;  // atoms
  Duration duration{0};             // at least
  Duration window{0};               // the longest
};

struct GroundModel {
  TupleTable atoms;
  std::vector<bool> derived;  // by atom
  TupleTable numbers;         // fluents that change; their index is the NumberId
  ExpressionPool expressions;
  std::vector<std::uint32_t> initial_atoms;
  std::vector<double> initial_numbers;  // NaN: undefined
  std::vector<GroundAction> actions;
  // Sorted lists, the first is empty. Neighbours of equal mentions share one.
  std::vector<std::vector<Mention>> mentions = std::vector<std::vector<Mention>>(1);
  std::vector<TooLong> too_long;   // taken out of `actions`
  std::vector<GroundRule> rules;   // by layer
  std::vector<TimedChange> timed;  // by time, one per instant
  Disjunction goal;
  Metric metric;
  std::vector<bool> only_metric_asks;          // by number: nothing else does, and it is never assigned
  std::vector<std::string> unreachable_goals;  // as text, if `goal` has no alternative from the beginning

  const std::vector<Mention>& mentions_of(const GroundAction& action) const {
    return mentions[action.mentions];
  }
};

}  // namespace roci::planner::temporal_pddl
