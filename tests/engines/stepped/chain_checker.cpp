#include "tests/engines/stepped/chain_checker.hpp"

#include <algorithm>

#include "tests/engines/checking/sequence_check.hpp"

namespace roci::planner::proof {

using engine::CheckedPlan, engine::Goal;
using temporal::ActivityState, temporal::CommitState, temporal::PlanActivity;

namespace {

class ChainCheck {
 public:
  explicit ChainCheck(const CheckedPlan& checked)
      : checked_(checked), model_(read_model(checked.request.model)) {}

  std::vector<std::string> run() {
    SequenceReport report = check_sequence(model_, checked_);
    faults_ = std::move(report.faults);
    check_commitments();
    if (checked_.before != nullptr && checked_.before->origin != checked_.plan.origin)
      fault("its origin has moved");
    if (checked_.before == nullptr && checked_.plan.origin != checked_.request.origin)
      fault("its origin is not the time of the step");
    check_goals(report.order);
    return std::move(faults_);
  }

 private:
  void fault(std::string text) { faults_.push_back(std::move(text)); }

  ActivityState state_of(const PlanActivity& activity) const {
    if (checked_.progress == nullptr) return ActivityState::waiting;
    const auto found = checked_.progress->find(activity.id);
    return found == checked_.progress->end() ? ActivityState::waiting : found->second.state;
  }

  // What is committed or has begun stands in every version as before.
  void check_commitments() {
    bool committed_one = false;
    for (const PlanActivity& activity : checked_.plan.activities) {
      if (activity.commit != CommitState::committed || state_of(activity) != ActivityState::waiting) continue;
      if (committed_one) fault(activity.id + " is committed too early");
      committed_one = true;
    }
    if (checked_.before == nullptr) return;
    for (const PlanActivity& old : checked_.before->activities) {
      if (old.commit == CommitState::planned && state_of(old) == ActivityState::waiting) continue;
      const auto now = std::ranges::find(checked_.plan.activities, old.id, &PlanActivity::id);
      if (now == checked_.plan.activities.end() || *now != old)
        fault(old.id + " is committed and has changed");
    }
  }

  // Each activity to come is for one goal that is open, or was when it was committed; a goal holds after the last of
  // its activities.
  void check_goals(const std::vector<std::size_t>& order) {
    for (const std::size_t index : order) {
      const PlanActivity& activity = checked_.plan.activities[index];
      const bool loose =
          activity.commit == CommitState::planned && state_of(activity) == ActivityState::waiting;
      if (activity.goals_served.size() != 1) {
        fault(activity.id + " is not for one goal");
      } else if (loose && goal(activity.goals_served.front()) == nullptr) {
        fault(activity.id + " is for no goal that is open");
      }
    }
    for (const Goal& open : checked_.request.goals) check_goal(open, order);
  }

  void check_goal(const Goal& open, const std::vector<std::size_t>& order) {
    const auto kind = model_.goals.find(open.kind);
    engine::Timelines state = checked_.request.state;
    bool served = false;
    bool achieved = true;
    for (const std::size_t index : order) {
      const PlanActivity& activity = checked_.plan.activities[index];
      const Task* task = model_.task(activity.name);
      if (task == nullptr || is_over(state_of(activity))) continue;
      for (const Held& held : task->sets) state[held.timeline] = temporal::state(held.value);
      if (std::ranges::count(activity.goals_served, open.key()) == 0) continue;
      served = true;
      achieved = kind != model_.goals.end() && satisfied(condition_of(kind->second), state);
    }
    if (served && !achieved) fault("it does not achieve " + open.key());
  }

  const Goal* goal(const std::string& key) const {
    const auto found = std::ranges::find(checked_.request.goals, key, &Goal::key);
    return found == checked_.request.goals.end() ? nullptr : &*found;
  }

  const CheckedPlan& checked_;
  TaskModel model_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> ChainChecker::faults(const CheckedPlan& checked) const {
  return ChainCheck(checked).run();
}

}  // namespace roci::planner::proof
