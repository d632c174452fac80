// A proof engine that plans all the time: a chain of tasks for each goal, one after the other, committed shortly
// before they start.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "tests/engines/model/task_model.hpp"

namespace roci::planner::proof {

// Goals of a kind ask for what the model's line `goal KIND TIMELINE VALUE` says. Chains are found backwards, by
// regression: what is wanted, before the task that brings it about what that needs, and so on. What is committed or
// has begun stays; all else is planned again when a goal comes or ends, a step fails or a conflict is seen ahead.
class ChainEngine final : public engine::SteppedEngine {
 public:
  // Throws ModelError.
  explicit ChainEngine(const engine::Setup& setup);

  engine::StepOutput step(const engine::StepInputs& inputs) override;

 private:
  void hear(const engine::StepInputs& inputs);
  void take(const engine::StepStatus& step);
  void hear_receipt(const engine::Receipt& receipt, temporal::Time now);
  temporal::ActivityState state_of(const temporal::PlanActivity& activity) const;
  bool is_loose(const temporal::PlanActivity& activity) const;
  bool is_served(const std::string& goal) const;
  bool loose_is_stale() const;
  void drop_loose();
  engine::Timelines state_at_end() const;
  void plan_missing(temporal::Time now, std::uint32_t version);
  void append(const Task& task, const std::string& goal, temporal::Time now, std::uint32_t version);
  void commit_next(temporal::Time now);

  engine::Setup setup_;
  TaskModel model_;
  std::vector<engine::Goal> goals_;  // open ones, as they came
  engine::Timelines state_;
  temporal::Progress progress_;
  temporal::FlexiblePlan plan_;
  temporal::FlexiblePlan told_;  // as it was sent last
  std::vector<engine::BlockingGoal> blocking_;
  std::uint32_t appended_ = 0;    // to the version that is made
  bool doubtful_ = false;         // what is loose
  bool open_ = false;             // the executive takes plans
  temporal::Time not_before_{0};  // after a refusal
  std::optional<temporal::Time> wake_;
};

}  // namespace roci::planner::proof
