#include "tests/engines/checking/sequence_check.hpp"

#include <algorithm>
#include <numeric>

#include "core/temporal/schedule.hpp"

namespace roci::planner::proof {

using engine::CheckedPlan, engine::Timelines;
using temporal::ActivityState, temporal::Duration, temporal::FlexiblePlan, temporal::PlanActivity;

namespace {

class SequenceCheck {
 public:
  SequenceCheck(const TaskModel& model, const CheckedPlan& checked)
      : model_(model), checked_(checked), plan_(checked.plan), state_(checked.request.state) {}

  SequenceReport run() {
    report_.faults = temporal::check(plan_);
    if (plan_.engine != checked_.request.engine) fault("it comes from engine '" + plan_.engine + "'");
    if (!plan_.decisions.empty() || !plan_.tokens.empty()) fault("it holds what no task brings about");
    const auto times = temporal::earliest_schedule(plan_.point_count, temporal::all_constraints(plan_));
    if (!times) {
      fault("it has no schedule");
      return std::move(report_);
    }
    report_.order.resize(plan_.activities.size());
    std::iota(report_.order.begin(), report_.order.end(), 0U);
    std::ranges::stable_sort(report_.order, {}, [&](std::size_t index) {
      const PlanActivity& activity = plan_.activities[index];
      return std::pair((*times)[activity.start_point], (*times)[activity.end_point]);
    });
    for (std::size_t i = 0; i < report_.order.size(); ++i) {
      const PlanActivity& activity = plan_.activities[report_.order[i]];
      if (i > 0) check_order(plan_.activities[report_.order[i - 1]], activity);
      check_activity(activity);
    }
    report_.final_state = std::move(state_);
    return std::move(report_);
  }

 private:
  void fault(std::string text) { report_.faults.push_back(std::move(text)); }

  ActivityState state_of(const PlanActivity& activity) const {
    if (checked_.progress == nullptr) return ActivityState::waiting;
    const auto found = checked_.progress->find(activity.id);
    return found == checked_.progress->end() ? ActivityState::waiting : found->second.state;
  }

  void check_order(const PlanActivity& first, const PlanActivity& second) {
    if (is_over(state_of(first))) return;
    const bool ordered = std::ranges::any_of(plan_.constraints, [&](const auto& constraint) {
      return constraint.from_point == first.end_point && constraint.to_point == second.start_point &&
             constraint.lower >= Duration{0};
    });
    if (!ordered) fault(second.id + " may overlap with " + first.id);
  }

  void check_activity(const PlanActivity& activity) {
    const Task* task = model_.task(activity.name);
    if (task == nullptr) return fault(activity.id + ": the model has no task '" + activity.name + "'");
    check_command(activity, *task);
    const ActivityState state = state_of(activity);
    if (is_over(state)) return;
    if (state == ActivityState::waiting) begin(activity, *task);
    for (const Held& held : task->sets) state_[held.timeline] = temporal::state(held.value);
  }

  void check_command(const PlanActivity& activity, const Task& task) {
    const auto expect = [&](bool right, const char* what) {
      if (!right) fault(activity.id + ": " + what + " is not that of its task");
    };
    expect(activity.owner == task.owner, "owner");
    expect(activity.robot == checked_.request.robot, "robot");
    expect(activity.subsystem == task.subsystem, "subsystem");
    expect(activity.command_name == task.command, "command");
    expect(activity.arguments.empty() && activity.then.empty(), "command's form");
    const Duration duration = duration_of(task);
    expect(activity.duration_lower == duration, "shortest duration");
    expect(activity.duration_upper == duration, "longest duration");
    expect(activity.pre == condition_of(task.needs), "condition at the start");
    expect(activity.maintenance == condition_of(task.needs), "condition meanwhile");
    expect(activity.post.empty() && activity.skip_if.empty() && !activity.may_skip, "course");
    expect(activity.impacts.size() == task.sets.size() + task.uses.size() &&
               std::ranges::all_of(task.sets, [&](const Held& held) { return sets(activity, held); }) &&
               std::ranges::all_of(task.uses, [&](const Drawn& drawn) { return draws(activity, drawn); }),
           "effect");
  }

  static bool sets(const PlanActivity& activity, const Held& held) {
    return std::ranges::count(activity.impacts, temporal::Impact{held.timeline, temporal::ImpactKind::assign,
                                                                 temporal::ImpactWhen::at_end,
                                                                 temporal::state(held.value)}) == 1;
  }
  static bool draws(const PlanActivity& activity, const Drawn& drawn) {
    return std::ranges::count(activity.impacts,
                              temporal::Impact{drawn.timeline, temporal::ImpactKind::delta,
                                               temporal::ImpactWhen::at_start, -drawn.amount}) == 1;
  }

  // As the owner of the function said in this call.
  Duration duration_of(const Task& task) const {
    for (const engine::FunctionUse& use : checked_.values)
      if (use.call.function == task.function && use.call.arguments == std::vector{task.name})
        return temporal::seconds(use.answer.value);
    return task.duration;
  }

  void begin(const PlanActivity& activity, const Task& task) {
    for (const Held& held : task.needs) {
      const auto found = state_.find(held.timeline);
      if (found == state_.end() || found->second != temporal::state(held.value))
        fault(activity.id + ": " + held.timeline + " is not " + held.value + " then");
    }
    for (const Drawn& drawn : task.uses) {
      double* number = std::get_if<double>(&state_[drawn.timeline]);
      if (number == nullptr || *number < drawn.amount) {
        fault(activity.id + ": there is not enough of " + drawn.timeline);
      } else {
        *number -= drawn.amount;
      }
    }
  }

  const TaskModel& model_;
  const CheckedPlan& checked_;
  const FlexiblePlan& plan_;
  Timelines state_;
  SequenceReport report_;
};

}  // namespace

SequenceReport check_sequence(const TaskModel& model, const CheckedPlan& checked) {
  return SequenceCheck(model, checked).run();
}

bool satisfied(const temporal::Condition& condition, const Timelines& state) {
  return temporal::evaluate(condition, [&](const std::string& timeline) -> std::optional<temporal::Value> {
           const auto found = state.find(timeline);
           return found == state.end() ? std::nullopt : std::optional(found->second);
         }) == temporal::Truth::yes;
}

}  // namespace roci::planner::proof
