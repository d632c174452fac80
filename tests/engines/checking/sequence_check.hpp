// What both proof checkers look at: a sequence of tasks, executed on the values of timelines. It sees the reader of
// models and no engine.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/engine/checker.hpp"
#include "tests/engines/model/task_model.hpp"

namespace roci::planner::proof {

struct SequenceReport {
  std::vector<std::string> faults;
  std::vector<std::size_t> order;  // indices of activities by start
  engine::Timelines final_state;
};

// Form; engine and robot; each activity against its task; order, so that no two overlap; needs and amounts in the
// state as it is then. Activities that are over have done what they do, those that run are only to end.
SequenceReport check_sequence(const TaskModel& model, const engine::CheckedPlan& checked);

bool satisfied(const temporal::Condition& condition, const engine::Timelines& state);

}  // namespace roci::planner::proof
