// This file finds an asked decision of a running plan again in the behaviour that left it open.
#pragma once

#include <optional>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/timeline_htn/search/ground.hpp"

namespace roci::planner::timeline_htn::adapter {

/// Says which decision of which behaviour it is, and with which objects.
struct AskedDecision {
  model::Index behaviour = 0;
  model::Index decision = 0;
  std::vector<model::Index> objects;  ///< of the behaviour's variables, as they were planned
  /// Says by subgoal whether the first choice carries its activity out, or its arguments are bound.
  std::vector<bool> concerned;

  const model::Behaviour& of(const model::Model& model) const { return model.behaviours[behaviour]; }
};

/// Looks for the activity that the decision belongs to: it stands above some that it chooses or binds, is named like a
/// state or behaviour that has this decision, and its parts are that one's subgoals. Ids of activities may be others
/// than those that the engine gave. Returns nothing where the model has no such behaviour.
std::optional<AskedDecision> find_asked(search::Ground& ground, const temporal::FlexiblePlan& plan,
                                        const temporal::DecisionPoint& point);

}  // namespace roci::planner::timeline_htn::adapter
