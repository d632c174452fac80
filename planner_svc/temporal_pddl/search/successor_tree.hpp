// Finds the snap actions whose facts hold in a state: a decision tree over the finite-domain variables
// (Helmert 2006, section 5.3.1).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class SuccessorTree {
 public:
  // Starts and plain actions; ends and timed literals are found from the plan.
  explicit SuccessorTree(const Task& task);

  // Appends the snap actions of which pre⊢ holds, and of pre↔ what the start does not add, negated facts and
  // numbers left out, in a fixed order.
  void collect(StateView state, std::vector<SnapId>& result) const;

 private:
  struct Test {
    std::uint32_t variable = 0;
    std::uint32_t value = 0;
    auto operator<=>(const Test&) const = default;
  };
  struct Candidate {
    SnapId snap;
    std::vector<Test> tests;  // ascending by variable
  };
  struct Node {
    std::uint32_t variable = 0;
    std::vector<SnapId> here;             // no test left
    std::vector<std::uint32_t> by_value;  // child of each value, 0: none
    std::uint32_t otherwise = 0;          // child of those that do not test the variable, 0: none
  };

  std::uint32_t build(std::span<Candidate> candidates, std::size_t depth);
  void collect(std::uint32_t node, StateView state, std::vector<SnapId>& result) const;

  const Task& task_;
  std::vector<Node> nodes_;  // [0] is unused
  std::uint32_t root_ = 0;
};

}  // namespace roci::planner::temporal_pddl
