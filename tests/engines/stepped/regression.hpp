// Regression: search backwards from what is wanted to what holds (Ghallab, Nau and Traverso 2004, section 4.2).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/request.hpp"
#include "tests/engines/model/task_model.hpp"

namespace roci::planner::proof {

struct Chain {
  std::vector<const Task*> tasks;  // in the order of their execution; of the model
  bool found = false;
  std::string timeline;  // that stands in the way; empty: not known
  std::string reason;
};

// The chain of fewest tasks from the state to all that is wanted, within the numbers that are there.
Chain chain_to(const TaskModel& model, const std::vector<Held>& wanted, const engine::Timelines& state);

}  // namespace roci::planner::proof
