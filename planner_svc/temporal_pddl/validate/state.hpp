// This file holds the world at one moment, and what a happening reads and changes of it. Facts and fluents go
// by their printed form, "(at rover base)".
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Holds the world at one moment; a fact that is not in it is false.
struct State {
  std::unordered_set<std::string> facts;
  std::unordered_map<std::string, double> values;  ///< absent: undefined
};

/// Holds what conditions and values depend on. An entry may stand in it twice.
struct Reads {
  std::vector<std::string> facts;
  std::vector<std::string> values;
};

/// Changes one fluent by an operand.
struct NumericChange {
  std::string fluent;
  pddl::AssignmentOperator op = pddl::AssignmentOperator::assign;
  double operand = 0;
};

/// Holds what one happening, or several of one moment, change.
struct Changes {
  std::vector<std::string> deleted;
  std::vector<std::string> added;
  std::vector<NumericChange> numeric;
};

/// Returns whether the operator is increase or decrease: these commute with one another, and nothing else
/// does.
bool is_additive(pddl::AssignmentOperator op);

/// Deletes before it adds. If a change needs a value that is undefined or its result is not finite, that
/// change is left out, `fluent` tells which it was, and the result is false.
bool apply(const Changes& changes, State& state, std::string& fluent);

}  // namespace roci::planner::temporal_pddl::validate
