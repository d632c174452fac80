// A condition over timelines is a tree in prefix order in one flat array, evaluated in three-valued logic
// (R84).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/value.hpp"

namespace roci::temporal {

/// Says what a node does, in the order of ConditionOp in idl/condition.idl.
enum class ConditionOp {
  always,    ///< always holds
  all_of,    ///< is followed by child_count subtrees
  any_of,    ///< is followed by child_count subtrees
  negation,  ///< is followed by one subtree
  eq,
  ne,
  lt,
  le,
  ge,
  gt
};

/// Holds one node of a condition's tree; its subtrees follow it in the array.
struct ConditionNode {
  ConditionOp op = ConditionOp::always;
  std::uint32_t child_count = 0;
  std::string timeline{};
  Value operand{};
  friend bool operator==(const ConditionNode&, const ConditionNode&) = default;
};

/// Holds a condition; without nodes it is always true.
struct Condition {
  std::vector<ConditionNode> nodes;
  bool empty() const { return nodes.empty(); }
  friend bool operator==(const Condition&, const Condition&) = default;
};

/// Returns the condition `timeline op operand`. eq and ne compare any kind; a state without arguments as
/// operand stands for that state with any arguments. lt, le, ge, gt compare numbers.
Condition compare(std::string timeline, ConditionOp op, Value operand);
Condition all_of(const std::vector<Condition>& parts);
Condition any_of(const std::vector<Condition>& parts);
Condition negate(const Condition& part);

/// Names the values of three-valued logic.
enum class Truth { no, unknown, yes };

/// Returns the value of a timeline, or nothing where it was never observed.
using Lookup = std::function<std::optional<Value>(const std::string& timeline)>;

/// Evaluates in Kleene's strong logic. A timeline without a value, a comparison of unlike kinds and a
/// malformed tree are unknown.
Truth evaluate(const Condition& condition, const Lookup& lookup);

/// Says the condition in plain words: "rover.nav = idle-at(wp-1) and (battery >= 500 or not comm.window =
/// true)", or "always" if it is empty.
std::string describe(const Condition& condition);

/// Says why it does not hold: the comparisons that are false or unknown, with the values found, as in
/// "battery >= 500 (is 120)" or "rover.nav = idle (never observed)". The text is empty if it holds.
std::string explain(const Condition& condition, const Lookup& lookup);

/// Says what is wrong with the tree's form (child counts, missing operands, numbers wanted); the text is
/// empty if it is well formed.
std::string check(const Condition& condition);

/// Returns the names of the timelines that it looks at, sorted, each once.
std::vector<std::string> timelines_of(const Condition& condition);

}  // namespace roci::temporal
