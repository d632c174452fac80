#include "tests/engines/lock_executive.hpp"

#include <algorithm>

#include "core/temporal/schedule.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/engines/model/lock.hpp"

namespace roci::planner::proof {

namespace topics = services::topics;
using namespace std::chrono_literals;
using temporal::ActivityState, temporal::CommitState, temporal::PlanActivity, temporal::Time;

LockExecutive::LockExecutive(services::Node& node)
    : node_(node),
      model_(read_model(kLockModel)),
      goals_out_(services::advertise(node, topics::goal)),
      statuses_(services::advertise(node, topics::goal_status)),
      observations_(services::advertise(node, topics::observation)),
      steps_(services::advertise(node, topics::step_status)),
      receipts_(services::advertise(node, topics::plan_receipt)),
      plans_(services::advertise(node, topics::plan)) {
  services::subscribe(node, topics::plan_delta, [this](const v1::PlanDelta& delta) { take(delta); });
  node.at(0s, [this] {
    for (const auto& [timeline, value] : std::vector<Held>{
             {"level", "low"}, {"lower", "shut"}, {"upper", "shut"}, {"ship", "below"}, {"quay", "dry"}})
      observe(timeline, temporal::state(value));
    observe("energy", 100.0);
    tell_receipt();
  });
}

void LockExecutive::ask_at(Time time, const std::string& kind, const std::string& id) {
  node_.at(time, [this, kind, id] {
    Goal& goal = goals_[id];
    goal.wish.issuer("ground");
    goal.wish.id(id);
    goal.wish.goal_kind(kind);
    goal.wish.preferred_us(-1);
    goals_out_.write(goal.wish);
    tell_goal(goal, v1::GOAL_PENDING);
  });
}

void LockExecutive::recall_at(Time time, const std::string& id) {
  node_.at(time, [this, id] { tell_goal(goals_.at(id), v1::GOAL_RECALLED); });
}

void LockExecutive::observe_at(Time time, const std::string& timeline, const temporal::Value& value) {
  node_.at(time, [this, timeline, value] { observe(timeline, value); });
}

void LockExecutive::take(const v1::PlanDelta& wire) {
  const temporal::PlanDelta delta = services::wire::from_wire(wire);
  const temporal::FlexiblePlan before = plan_;
  std::string fault = delta.added.version <= plan_.version ? "an old version" : apply(delta, plan_);
  if (const auto found = check(plan_); fault.empty() && !found.empty()) fault = found.front();
  for (const PlanActivity& old : before.activities) {
    if (old.commit == CommitState::planned && !begun_.contains(old.id)) continue;
    const auto now = std::ranges::find(plan_.activities, old.id, &PlanActivity::id);
    if (now == plan_.activities.end() || *now != old) fault = old.id + " was committed";
  }
  if (!fault.empty()) faults.push_back(fault);
  versions.push_back(plan_.version);
  std::string tasks;
  for (const PlanActivity& activity : plan_.activities)
    if (!is_over(state_of(activity))) tasks += (tasks.empty() ? "" : ", ") + activity.name;
  planned.push_back(tasks);
  v1::Plan adopted = services::wire::to_wire(plan_);
  adopted.executive(node_.options().name);
  plans_.write(std::move(adopted));
  tell_receipt();
  dispatch();
}

// What is committed starts once all before it are over and its window is open.
void LockExecutive::dispatch() {
  for (const PlanActivity& activity : plan_.activities) {
    if (is_over(state_of(activity))) continue;
    if (state_of(activity) != ActivityState::waiting || activity.commit != CommitState::committed) return;
    Time start = node_.now();
    for (const temporal::TemporalConstraint& constraint : plan_.constraints)
      if (constraint.from_point == temporal::origin_point && constraint.to_point == activity.start_point)
        start = std::max(start, plan_.origin + constraint.lower);
    if (start > node_.now()) {
      node_.at(start, [this] { dispatch(); });
    } else {
      begin(activity);
    }
    return;
  }
}

void LockExecutive::begin(const PlanActivity& activity) {
  if (!begun_.insert(activity.id).second) faults.push_back(activity.id + " began twice");
  for (const Held& held : model_.task(activity.name)->needs)
    if (values_[held.timeline] != temporal::state(held.value))
      faults.push_back(activity.id + ": " + held.timeline + " is not " + held.value);
  progress_[activity.id] = {ActivityState::running, node_.now(), {}};
  for (const temporal::Impact& impact : activity.impacts)
    if (impact.kind == temporal::ImpactKind::delta)
      observe(impact.timeline, std::get<double>(values_[impact.timeline]) + std::get<double>(impact.amount));
  tell_step(activity.id);
  node_.after(activity.duration_lower, [this, id = activity.id] { end(id); });
}

void LockExecutive::end(const std::string& id) {
  const PlanActivity activity = *std::ranges::find(plan_.activities, id, &PlanActivity::id);
  const bool fails = failing_.erase(activity.name) > 0;
  done.push_back(activity.name + (fails ? "!" : ""));
  if (!fails)
    for (const Held& held : model_.task(activity.name)->sets)
      observe(held.timeline, temporal::state(held.value));
  progress_[id].state = fails ? ActivityState::failed : ActivityState::succeeded;
  progress_[id].ended = node_.now();
  tell_step(id);
  for (auto& [key, goal] : goals_) {
    if (goal.state != v1::GOAL_PENDING) continue;
    const auto& wanted = model_.goals.at(goal.wish.goal_kind());
    const bool holds = std::ranges::all_of(
        wanted, [&](const Held& held) { return values_[held.timeline] == temporal::state(held.value); });
    if (!holds) continue;
    achieved.insert(key);
    tell_goal(goal, v1::GOAL_ACHIEVED);
  }
  dispatch();
}

void LockExecutive::observe(const std::string& timeline, const temporal::Value& value) {
  values_[timeline] = value;
  v1::Observation out;
  out.timeline(timeline);
  out.observed(services::wire::to_wire(value));
  out.sampled_us(node_.now().count());
  observations_.write(std::move(out));
}

void LockExecutive::tell_goal(Goal& goal, v1::GoalState state) {
  goal.state = state;
  v1::GoalStatus out;
  out.executive(node_.options().name);
  out.issuer(goal.wish.issuer());
  out.id(goal.wish.id());
  out.goal_state(state);
  statuses_.write(std::move(out));
}

void LockExecutive::tell_step(const std::string& activity) {
  const temporal::ActivityProgress& progress = progress_.at(activity);
  v1::StepStatus out;
  out.executive(node_.options().name);
  out.activity(activity);
  out.plan_version(plan_.version);
  out.state(static_cast<v1::ActivityState>(progress.state));
  out.started_us(progress.started ? progress.started->count() : -1);
  out.ended_us(progress.ended ? progress.ended->count() : -1);
  steps_.write(std::move(out));
}

void LockExecutive::tell_receipt() {
  v1::PlanReceipt out;
  out.executive(node_.options().name);
  out.version(plan_.version);
  out.open(true);
  receipts_.write(std::move(out));
}

ActivityState LockExecutive::state_of(const PlanActivity& activity) const {
  const auto found = progress_.find(activity.id);
  return found == progress_.end() ? ActivityState::waiting : found->second.state;
}

}  // namespace roci::planner::proof
