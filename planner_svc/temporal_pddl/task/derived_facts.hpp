// The derived facts of a state are the least fixed point of their rules, layer by layer (PDDL 2.2, section
// 3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"
#include "planner_svc/temporal_pddl/task/state_layout.hpp"

namespace roci::planner::temporal_pddl::task {

/// Makes the head true wherever its conditions and comparisons hold.
struct DerivationRule {
  FactId head;
  int layer = 0;
  std::vector<FactId> conditions;
  std::vector<NumericCondition> comparisons;
};

/// Holds the rules of a task and sets the derived facts of its states.
class DerivedFacts {
 public:
  DerivedFacts() = default;
  /// Takes the rules in ascending order of their layers. A rule may depend on the negation of facts of lower
  /// layers only.
  explicit DerivedFacts(std::span<const DerivationRule> rules);

  bool empty() const { return rules_.empty(); }
  /// Sets the derived facts of a state as all its other facts and numbers demand.
  void complete(const StateLayout& layout, const ExpressionPool& expressions, MutableState state) const;
  std::span<const NumericCondition> comparisons(std::size_t rule) const { return comparisons_[rule]; }
  std::size_t rules() const { return rules_.size(); }

 private:
  struct Rule {
    std::uint32_t head = 0;     // index of heads_
    std::uint32_t awaited = 0;  // conditions that its own layer derives
  };

  std::vector<FactId> heads_;
  std::vector<Rule> rules_;
  std::vector<std::uint32_t> layer_ends_;    // in rules_
  FlatLists<FactId> settled_;                // by rule: conditions that the layer does not change
  FlatLists<NumericCondition> comparisons_;  // by rule
  FlatLists<std::uint32_t> awaited_by_;      // by head: rules of its layer
};

}  // namespace roci::planner::temporal_pddl::task
