// The world at one moment, and what a happening reads and changes of it. Facts and fluents go by their
// printed form,
// "(at rover base)".
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::planner::temporal_pddl::validate {

struct State {
  std::unordered_set<std::string> facts;
  std::unordered_map<std::string, double> values;  ///< absent: undefined
};

/// What conditions and values depend on. May hold an entry twice.
struct Reads {
  std::vector<std::string> facts;
  std::vector<std::string> values;
};

struct NumericChange {
  std::string fluent;
  pddl::AssignmentOperator op = pddl::AssignmentOperator::assign;
  double operand = 0;
};

struct Changes {
  std::vector<std::string> deleted;
  std::vector<std::string> added;
  std::vector<NumericChange> numeric;
};

/// increase and decrease commute with one another; nothing else does.
bool is_additive(pddl::AssignmentOperator op);

/// Deletes before it adds. False, with the state unchanged by that change, if a change needs a value that is
/// undefined or the result is not finite; `fluent` then tells which.
bool apply(const Changes& changes, State& state, std::string& fluent);

}  // namespace roci::planner::temporal_pddl::validate
