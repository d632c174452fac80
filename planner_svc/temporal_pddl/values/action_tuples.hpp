// Which tuples of external functions an action instance stands on.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

namespace roci::planner::temporal_pddl::values {

/// Names an action instance by the ids that grounding gives to schemas and objects of the model.
struct ActionInstance {
  task::SchemaId schema;
  std::vector<task::ObjectId> arguments;
};

/// Knows the model without its numbers; it may be asked as long as it lives.
class ActionTuples {
 public:
  /// Takes a model in which check() finds nothing wrong. Throws ModelFailure as grounding does.
  ActionTuples(const pddl::Domain& domain, const pddl::Problem& problem);

  /// Appends a call for each external tuple that the instance reads: in its duration, its conditions (all
  /// alternatives of them) and its effects. A tuple may come twice.
  void collect(const ActionInstance& instance, std::vector<engine::FunctionCall>& calls) const;
  /// Does the same for an action by its names; of an action that the model does not have there are none.
  void collect(const std::string& action, const std::vector<std::string>& arguments,
               std::vector<engine::FunctionCall>& calls) const;

  /// Names the functions that the goal, the metric or a derived predicate reads: every plan stands on them.
  const std::set<std::string>& read_by_all() const { return read_by_all_; }

 private:
  grounding::lifted::Symbols symbols_;
  std::vector<grounding::lifted::LiftedAction> actions_;  // by SchemaId
  std::set<std::string> read_by_all_;
};

}  // namespace roci::planner::temporal_pddl::values
