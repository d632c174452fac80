// Stands in for executive and lock: takes goals and versions of a plan, carries out what is committed, and says what
// becomes of it, as exec_svc and the owner of a lock would.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/plan_delta.hpp"
#include "core/temporal/projection.hpp"
#include "services/publisher.hpp"
#include "tests/engines/model/task_model.hpp"

namespace roci::planner::proof {

class LockExecutive {
 public:
  explicit LockExecutive(services::Node& node);

  // At this mission time; a kind of the lock's model.
  void ask_at(temporal::Time time, const std::string& kind, const std::string& id);
  void recall_at(temporal::Time time, const std::string& id);
  void observe_at(temporal::Time time, const std::string& timeline, const temporal::Value& value);
  // The first try of this task ends in a failure.
  void fail_first(const std::string& task) { failing_.insert(task); }

  std::vector<std::string> done;  // tasks, in their order; "task!" one that failed
  std::set<std::string> achieved;
  std::vector<std::string> faults;  // what an executive would refuse
  std::vector<std::uint32_t> versions;
  std::vector<std::string> planned;  // tasks of each version, as it came

 private:
  struct Goal {
    v1::Goal wish;
    v1::GoalState state = v1::GOAL_PENDING;
  };

  void take(const v1::PlanDelta& delta);
  void dispatch();
  void begin(const temporal::PlanActivity& activity);
  void end(const std::string& id);
  void observe(const std::string& timeline, const temporal::Value& value);
  void tell_goal(Goal& goal, v1::GoalState state);
  void tell_step(const std::string& activity);
  void tell_receipt();
  temporal::ActivityState state_of(const temporal::PlanActivity& activity) const;

  services::Node& node_;
  TaskModel model_;
  services::Publisher<v1::Goal> goals_out_;
  services::Publisher<v1::GoalStatus> statuses_;
  services::Publisher<v1::Observation> observations_;
  services::Publisher<v1::StepStatus> steps_;
  services::Publisher<v1::PlanReceipt> receipts_;
  services::Publisher<v1::Plan> plans_;
  std::map<std::string, Goal> goals_;
  std::map<std::string, temporal::Value> values_;
  temporal::FlexiblePlan plan_;
  temporal::Progress progress_;
  std::set<std::string> failing_;
  std::set<std::string> begun_;  // ids, ever
};

}  // namespace roci::planner::proof
