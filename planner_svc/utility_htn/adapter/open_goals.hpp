// Open goals are what the executive has taken and not ended: requests, each for one task of the network, and all
// others, which the whole plan serves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/planned_network.hpp"

namespace roci::planner::utility_htn::adapter {

/// Keeps the goals, and asks the cycle for the tasks that requests name.
class OpenGoals {
 public:
  bool empty() const { return goals_.empty(); }
  /// Lists requests that name no task of the network, each with the reason.
  const std::vector<engine::BlockingGoal>& blocking() const { return blocking_; }

  /// Takes in a new or changed goal.
  void hear(const engine::Goal& goal, PlannedNetwork& planned);
  /// Takes in that a goal has ended. What serves a request that was not achieved is withdrawn.
  void hear(const engine::EndedGoal& ended, PlannedNetwork& planned);
  /// Takes all of them in again, since another network is in force. What was given up for them stays so.
  void hear_again(PlannedNetwork& planned);

  /// Returns the keys of the goals that every activity serves.
  std::vector<std::string> served_by_all() const;
  /// Has the activities that a request alone has brought into the plan serve it and nothing else.
  void serve_requests(temporal::FlexiblePlan& plan, const PlannedNetwork& planned) const;

 private:
  std::optional<model::TaskIndex> note(const engine::Goal& goal, const PlannedNetwork& planned);

  std::vector<engine::Goal> goals_;
  std::vector<engine::BlockingGoal> blocking_;
};

}  // namespace roci::planner::utility_htn::adapter
