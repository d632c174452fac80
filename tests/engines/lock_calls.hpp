// Requests and plans of the ship lock, for tests.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/engine/checked_answer.hpp"
#include "tests/engines/model/lock.hpp"
#include "tests/engines/model/task_model.hpp"
#include "tests/engines/table.hpp"

namespace roci::planner::proof {

// An empty chamber at the lower level, both gates shut, the ship below.
inline engine::Timelines lock_at_rest() {
  engine::Timelines state;
  for (const auto& [timeline, value] : std::vector<Held>{
           {"level", "low"}, {"lower", "shut"}, {"upper", "shut"}, {"ship", "below"}, {"quay", "dry"}})
    state[timeline] = temporal::state(value);
  state["energy"] = 100.0;
  return state;
}

inline engine::Goal goal_of(const std::string& id, const std::vector<Held>& held) {
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = id;
  goal.achieved = condition_of(held);
  return goal;
}

inline engine::Request lock_request(std::vector<engine::Goal> goals) {
  engine::Request request;
  request.engine = "search";
  request.origin = temporal::seconds(1000);
  request.model = kLockModel;
  request.state = lock_at_rest();
  request.goals = std::move(goals);
  return request;
}

inline engine::Answer answer_to(const engine::Request& request) {
  engine::NoFunctions functions;
  return engine::answer_checked(engines(), request, {}, functions);
}

// "fill, open-upper": the tasks in the order of the plan's list.
inline std::string tasks_of(const temporal::FlexiblePlan& plan) {
  std::string out;
  for (const temporal::PlanActivity& activity : plan.activities)
    out += (out.empty() ? "" : ", ") + activity.name;
  return out;
}

}  // namespace roci::planner::proof
