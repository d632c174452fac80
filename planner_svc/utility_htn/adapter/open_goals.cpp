#include "planner_svc/utility_htn/adapter/open_goals.hpp"

#include <algorithm>
#include <optional>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::planner::utility_htn::adapter {

using engine::Goal;

namespace {

constexpr char kRequest[] = "request";

const std::string* argument(const Goal& goal, const std::string& name) {
  const auto found = std::ranges::find(goal.arguments, name, &temporal::Property::name);
  return found == goal.arguments.end() ? nullptr : &found->value;
}

// Returns the task that a goal asks for; nothing if it is no request, or names none.
std::optional<model::TaskIndex> requested_by(const Goal& goal, const PlannedNetwork& planned) {
  if (goal.kind != kRequest) return std::nullopt;
  const std::string* const name = argument(goal, "task");
  return name == nullptr ? std::nullopt : planned.task_named(*name);
}

}  // namespace

void OpenGoals::hear(const Goal& goal, PlannedNetwork& planned) {
  if (const auto task = note(goal, planned)) planned.cycle().request(*task);
}

// Keeps the goal, and returns the task that it asks for.
std::optional<model::TaskIndex> OpenGoals::note(const Goal& goal, const PlannedNetwork& planned) {
  const auto known = std::ranges::find(goals_, goal.key(), &Goal::key);
  known == goals_.end() ? goals_.push_back(goal) : void(*known = goal);
  if (goal.kind != kRequest) return std::nullopt;
  std::erase_if(blocking_, [&](const auto& one) { return one.issuer == goal.issuer && one.id == goal.id; });
  const auto task = requested_by(goal, planned);
  if (!task) {
    const std::string* const name = argument(goal, "task");
    blocking_.push_back({goal.issuer, goal.id, "",
                         name == nullptr ? "a request names its task in the argument 'task'"
                                         : "the network has no task '" + *name + "'"});
  }
  return task;
}

void OpenGoals::hear(const engine::EndedGoal& ended, PlannedNetwork& planned) {
  const auto known = std::ranges::find_if(
      goals_, [&](const Goal& goal) { return goal.issuer == ended.issuer && goal.id == ended.id; });
  if (known == goals_.end()) return;
  const auto task = requested_by(*known, planned);
  if (task && ended.state != engine::GoalState::achieved) planned.cycle().withdraw(*task);
  goals_.erase(known);
  std::erase_if(blocking_, [&](const auto& one) { return one.issuer == ended.issuer && one.id == ended.id; });
}

void OpenGoals::hear_again(PlannedNetwork& planned) {
  for (const Goal& goal : std::vector(goals_))
    if (const auto task = note(goal, planned)) planned.cycle().still_requested(*task);
}

std::vector<std::string> OpenGoals::served_by_all() const {
  std::vector<std::string> out;
  for (const Goal& goal : goals_)
    if (goal.kind != kRequest) out.push_back(goal.key());
  return out;
}

void OpenGoals::serve_requests(temporal::FlexiblePlan& plan, const PlannedNetwork& planned) const {
  for (const Goal& goal : goals_) {
    const auto task = requested_by(goal, planned);
    if (!task) continue;
    for (const cycle::Block& block : planned.cycle().blocks()) {
      if (planned.chains().chains[block.chain].task != *task) continue;
      for (temporal::PlanActivity& activity : plan.activities) {
        const auto id = task_of(activity.id);
        if (id && cycle::block_of(*id) == block.number && activity.commit == temporal::CommitState::planned)
          activity.goals_served = {goal.key()};
      }
    }
  }
}

}  // namespace roci::planner::utility_htn::adapter
