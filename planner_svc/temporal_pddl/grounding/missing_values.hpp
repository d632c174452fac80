// Numbers without a value that keep actions from running, as causes of an unreachable goal.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/fact_patterns.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Finds what an action reads in vain. What it is given must outlive it.
class MissingValues {
 public:
  explicit MissingValues(const UnreachableGoal& known) : known_(known), patterns_(known) {}

  /// Returns one text for each number in the conditions, durations and effects of the action that never has a value
  /// under the binding, in which slots may be open: who reads it, and what to do. `by` names the action.
  std::vector<std::string> of(const lifted::LiftedAction& action,
                              const std::vector<const lifted::LiftedFormula*>& conditions,
                              const lifted::Binding& binding, const std::string& by) const;

 private:
  void collect(const lifted::LiftedExpression& expression, const std::string& by,
               const lifted::Binding& binding, std::vector<std::string>& told) const;
  void collect(task::FunctionId function, const std::vector<lifted::Argument>& arguments,
               const std::string& by, const lifted::Binding& binding, std::vector<std::string>& told) const;
  bool is_assigned(std::uint32_t number) const;

  const UnreachableGoal& known_;
  Patterns patterns_;
};

}  // namespace roci::planner::temporal_pddl::grounding
