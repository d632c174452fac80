// The successor generator (Helmert 2006, section 5.3.1) finds the snap actions whose facts hold in a state
// by a decision tree over the finite-domain variables.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Holds the decision tree of one task, which does not change.
class SuccessorGenerator {
 public:
  /// Holds starts and plain actions; ends and timed literals are found from the plan.
  explicit SuccessorGenerator(const task::Task& task);

  /// Appends the snap actions of which pre⊢ holds, and of pre↔ what the start does not add, negated facts and
  /// numbers left out, in a fixed order.
  void collect(task::StateView state, std::vector<task::SnapId>& result) const;

 private:
  struct Test {
    std::uint32_t variable = 0;
    std::uint32_t value = 0;
    auto operator<=>(const Test&) const = default;
  };
  struct Candidate {
    task::SnapId snap;
    std::vector<Test> tests;  // ascending by variable
  };
  struct Node {
    std::uint32_t variable = 0;
    std::vector<task::SnapId> here;       // no test left
    std::vector<std::uint32_t> by_value;  // child of each value, 0: none
    std::uint32_t otherwise = 0;          // child of those that do not test the variable, 0: none
  };

  void build(std::span<Candidate> all);

  const task::Task& task_;
  std::vector<Node> nodes_;  // [0] is no node: the tree is its `otherwise`
};

}  // namespace roci::planner::temporal_pddl::search
