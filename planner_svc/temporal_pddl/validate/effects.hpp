// This file turns the effects of an action into the changes that they make.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/validate/evaluator.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Holds one literal or assignment with its quantified variables bound. It carries the conditions of all
/// `when` around it, which are tested as their times come.
struct PendingEffect {
  const pddl::Effect* effect = nullptr;
  Bindings bindings;
  std::vector<const pddl::TimedCondition*> conditions;
  bool alive = true;  ///< no condition has failed so far
};

/// Unfolds `forall` and `when` into one entry per literal or assignment. The effects must outlive the result.
std::vector<PendingEffect> unfold(const std::vector<pddl::Effect>& effects, const Bindings& bindings,
                                  const Model& model);

/// Marks as not alive those effects whose conditions of this time (a member of TimedCondition) do not hold.
void check_conditions(std::vector<PendingEffect>& effects, pddl::Condition pddl::TimedCondition::*time,
                      Evaluator& evaluator);

/// Appends to `changes` what the effects that are alive change, seen from the evaluator's state. Returns
/// false if some value is undefined; that effect is left out, and evaluator.reason() says why.
bool collect(const std::vector<PendingEffect>& effects, const Specials& specials, Evaluator& evaluator,
             Changes& changes);

}  // namespace roci::planner::temporal_pddl::validate
