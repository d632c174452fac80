// A proof engine that answers calls: uniform-cost search forward over the values of timelines.
#pragma once

#include "planner_svc/engine/answering_engine.hpp"

namespace roci::planner::proof {

// Takes models of model/task_model.hpp. Its plans are sequences of least duration. Durations may be values of
// external functions: one tuple, the task's name. A goal that no tasks lead to even if nothing is ever undone, or
// that comes too late, is told as blocking.
class SearchEngine final : public engine::AnsweringEngine {
 public:
  engine::Answer answer(const engine::Request& request, const engine::Limits& limits,
                        engine::FunctionSource& functions) override;
};

}  // namespace roci::planner::proof
