#include "tests/engines/stepped/chain_engine.hpp"

#include <algorithm>
#include <utility>

#include "tests/engines/stepped/regression.hpp"

namespace roci::planner::proof {

using engine::Goal, engine::Receipt, engine::StepInputs, engine::StepOutput;
using temporal::ActivityState, temporal::CommitState, temporal::Duration, temporal::PlanActivity,
    temporal::Time;
using namespace std::chrono_literals;

namespace {

constexpr Duration kLead = 30s;          // from planning to the first start
constexpr Duration kCommitWindow = 20s;  // before a start
constexpr Duration kRefusalPause = 10s;

bool same_items(const temporal::FlexiblePlan& a, const temporal::FlexiblePlan& b) {
  return a.activities == b.activities && a.constraints == b.constraints;
}

}  // namespace

ChainEngine::ChainEngine(const engine::Setup& setup) : setup_(setup), model_(read_model(setup.model)) {}

StepOutput ChainEngine::step(const StepInputs& inputs) {
  hear(inputs);
  StepOutput out;
  wake_.reset();
  if (open_ && inputs.now >= not_before_) {
    appended_ = 0;
    if (loose_is_stale()) drop_loose();
    plan_missing(inputs.now, inputs.last_version + 1);
    commit_next(inputs.now);
    if (!same_items(plan_, told_)) {
      plan_.version = inputs.last_version + 1;
      out.delta = temporal::difference(told_, plan_);
      told_ = plan_;
    }
  } else if (open_) {
    wake_ = not_before_;
  }
  out.blocking = blocking_;
  out.wake = wake_;
  return out;
}

void ChainEngine::hear(const StepInputs& inputs) {
  for (const Goal& goal : inputs.goals) {
    const auto known = std::ranges::find(goals_, goal.key(), &Goal::key);
    known == goals_.end() ? goals_.push_back(goal) : void(*known = goal);
  }
  for (const engine::EndedGoal& ended : inputs.ended_goals)
    std::erase_if(goals_,
                  [&](const Goal& goal) { return goal.issuer == ended.issuer && goal.id == ended.id; });
  std::erase_if(blocking_, [&](const engine::BlockingGoal& blocked) {
    return std::ranges::none_of(
        goals_, [&](const Goal& goal) { return goal.issuer == blocked.issuer && goal.id == blocked.id; });
  });
  if (inputs.executed) plan_ = told_ = *inputs.executed;
  for (const engine::StepStatus& step : inputs.steps) take(step);
  for (const engine::Observation& observed : inputs.observations)
    state_.insert_or_assign(observed.timeline, observed.value);
  if (inputs.receipt) hear_receipt(*inputs.receipt, inputs.now);
}

// What ends well has done what it does, also before that is observed; what does not makes the rest doubtful.
void ChainEngine::take(const engine::StepStatus& step) {
  const auto known = progress_.find(step.activity);
  const bool ends = known != progress_.end() && !is_over(known->second.state) && is_over(step.progress.state);
  progress_.insert_or_assign(step.activity, step.progress);
  const auto activity = std::ranges::find(plan_.activities, step.activity, &PlanActivity::id);
  if (!ends || activity == plan_.activities.end()) return;
  if (step.progress.state != ActivityState::succeeded) doubtful_ = true;
  const Task* task = model_.task(activity->name);
  if (task == nullptr || step.progress.state != ActivityState::succeeded) return;
  for (const Held& held : task->sets) state_[held.timeline] = temporal::state(held.value);
}

void ChainEngine::hear_receipt(const Receipt& receipt, Time now) {
  open_ = receipt.open;
  if (!receipt.conflict.empty()) doubtful_ = true;
  if (receipt.refused != 0 && receipt.refused == told_.version) not_before_ = now + kRefusalPause;
  if (receipt.version == 0) {
    plan_ = told_ = {};
    progress_.clear();
  }
}

ActivityState ChainEngine::state_of(const PlanActivity& activity) const {
  const auto found = progress_.find(activity.id);
  return found == progress_.end() ? ActivityState::waiting : found->second.state;
}

bool ChainEngine::is_loose(const PlanActivity& activity) const {
  return activity.commit == CommitState::planned && state_of(activity) == ActivityState::waiting;
}

bool ChainEngine::is_served(const std::string& goal) const {
  return std::ranges::any_of(plan_.activities, [&](const PlanActivity& activity) {
    return !is_over(state_of(activity)) && std::ranges::count(activity.goals_served, goal) > 0;
  });
}

// Something loose is for no goal that is open, or what was planned will not come about.
bool ChainEngine::loose_is_stale() const {
  const auto is_open = [&](const std::string& key) {
    return std::ranges::find(goals_, key, &Goal::key) != goals_.end();
  };
  return std::ranges::any_of(plan_.activities, [&](const PlanActivity& activity) {
    return is_loose(activity) && (doubtful_ || !is_open(activity.goals_served.front()));
  });
}

void ChainEngine::drop_loose() {
  doubtful_ = false;
  std::vector<temporal::TimePoint> gone;
  std::erase_if(plan_.activities, [&](const PlanActivity& activity) {
    if (!is_loose(activity)) return false;
    gone.insert(gone.end(), {activity.start_point, activity.end_point});
    return true;
  });
  std::erase_if(plan_.constraints, [&](const temporal::TemporalConstraint& constraint) {
    return std::ranges::count(gone, constraint.from_point) + std::ranges::count(gone, constraint.to_point) >
           0;
  });
}

engine::Timelines ChainEngine::state_at_end() const {
  engine::Timelines state = state_;
  for (const PlanActivity& activity : plan_.activities) {
    const Task* task = model_.task(activity.name);
    if (task == nullptr || is_over(state_of(activity))) continue;
    if (state_of(activity) == ActivityState::waiting)
      for (const Drawn& drawn : task->uses)
        if (double* number = std::get_if<double>(&state[drawn.timeline])) *number -= drawn.amount;
    for (const Held& held : task->sets) state[held.timeline] = temporal::state(held.value);
  }
  return state;
}

void ChainEngine::plan_missing(Time now, std::uint32_t version) {
  blocking_.clear();
  for (const Goal& goal : goals_) {
    if (is_served(goal.key())) continue;
    const auto kind = model_.goals.find(goal.kind);
    if (kind == model_.goals.end()) {
      blocking_.push_back({goal.issuer, goal.id, "", "the model has no goal of kind '" + goal.kind + "'"});
      continue;
    }
    const Chain chain = chain_to(model_, kind->second, state_at_end());
    if (!chain.found) blocking_.push_back({goal.issuer, goal.id, chain.timeline, chain.reason});
    for (const Task* task : chain.tasks) append(*task, goal.key(), now, version);
  }
}

void ChainEngine::append(const Task& task, const std::string& goal, Time now, std::uint32_t version) {
  if (plan_.activities.empty() && plan_.point_count == 1) {
    plan_.engine = setup_.engine;
    plan_.id = setup_.engine;
    plan_.origin = now;
  }
  PlanActivity activity =
      activity_of(task, "v" + std::to_string(version) + "." + std::to_string(++appended_) + "-" + task.name,
                  setup_.robot, plan_.point_count);
  plan_.point_count += 2;
  activity.goals_served = {goal};
  if (plan_.activities.empty() || is_over(state_of(plan_.activities.back())))
    plan_.constraints.push_back({temporal::origin_point, activity.start_point,
                                 temporal::ConstraintKind::window, now + kLead - plan_.origin,
                                 temporal::no_bound});
  if (!plan_.activities.empty())
    plan_.constraints.push_back({plan_.activities.back().end_point, activity.start_point,
                                 temporal::ConstraintKind::ordering, Duration{0}, temporal::no_bound});
  plan_.activities.push_back(std::move(activity));
}

// The first loose activity once all before it are over and its start is near.
void ChainEngine::commit_next(Time now) {
  for (PlanActivity& activity : plan_.activities) {
    if (is_over(state_of(activity))) continue;
    if (!is_loose(activity)) return;
    Time start = now;
    for (const temporal::TemporalConstraint& constraint : plan_.constraints)
      if (constraint.from_point == temporal::origin_point && constraint.to_point == activity.start_point)
        start = std::max(start, plan_.origin + constraint.lower);
    if (start - now > kCommitWindow) {
      wake_ = start - kCommitWindow;
    } else {
      activity.commit = CommitState::committed;
    }
    return;
  }
}

}  // namespace roci::planner::proof
