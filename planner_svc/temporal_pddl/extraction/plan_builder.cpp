#include "planner_svc/temporal_pddl/extraction/plan_builder.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "planner_svc/temporal_pddl/extraction/goal_support.hpp"
#include "planner_svc/temporal_pddl/extraction/substitution.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_quality.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl::extraction {

using call::NamedGoal, call::Options;
using constraints::StepConstraint;
using grounding::Grounding;
using improvement::metric_of;
using search::PlanPrefix, search::TemporalCheck;
using task::ActionId, task::ObjectId, task::SchemaId, task::Snap, task::SnapKind, task::Task,
    task::TimeWindow;
using temporal::ConstraintKind, temporal::Duration, temporal::TimePoint, temporal::no_bound;

namespace {

class PlanBuilder {
 public:
  PlanBuilder(const pddl::Domain& domain, const Grounding& grounding, const PlanPrefix& steps,
              const Options& options, std::span<const NamedGoal> goals)
      : domain_(domain),
        grounding_(grounding),
        task_(grounding.task),
        steps_(steps),
        goals_(goals),
        describes_(options.describe_activities),
        check_(task_, options.epsilon) {}

  Plan run() {
    add_points();
    add_constraints();
    if (!goals_.empty()) served_ = goals_served(task_, steps_, goals_);
    add_activities();
    plan_.metric = metric_of(task_, steps_, plan_.makespan);
    return std::move(plan_);
  }

 private:
  static TimePoint point(std::size_t step) { return static_cast<TimePoint>(step + 1); }
  const Snap& snap(std::size_t step) const { return task_.snaps[steps_.steps[step]]; }

  void add_points() {
    const std::vector<Duration> earliest = *check_.earliest(steps_);
    windows_ = check_.chosen_windows(steps_, earliest);
    const std::vector<Duration> latest = TemporalCheck::latest(steps_, windows_);
    plan_.network.points.push_back({PointKind::origin, 0, Duration{0}, Duration{0}});
    for (std::size_t i = 0; i < steps_.steps.size(); ++i) {
      NetworkPoint added;
      added.kind = snap(i).kind == SnapKind::timed_literal ? PointKind::timed_literal
                   : snap(i).kind == SnapKind::end         ? PointKind::end
                                                           : PointKind::start;
      added.earliest = earliest[i];
      added.latest = latest[i];
      plan_.network.points.push_back(added);
    }
  }

  void add_constraints() {
    auto& constraints = plan_.network.constraints;
    for (std::size_t i = 0; i < steps_.constraints.size(); ++i) {
      const StepConstraint& source = steps_.constraints[i];
      const auto kind = is_duration(i) ? ConstraintKind::duration : ConstraintKind::ordering;
      if (kind == ConstraintKind::duration) duration_to_[point(source.to)] = constraints.size();
      constraints.push_back({point(source.from), point(source.to), kind, source.lower, source.upper});
    }
    for (std::size_t i = 0; i < steps_.steps.size(); ++i) {
      const bool windowed = windows_[i] != TimeWindow{};
      constraints.push_back({0, point(i), windowed ? ConstraintKind::window : ConstraintKind::ordering,
                             windows_[i].open, windows_[i].close});
    }
  }

  // An end's duration is the last constraint that its step has brought.
  bool is_duration(std::size_t constraint) const {
    const auto& all = steps_.constraints;
    const std::size_t to = all[constraint].to;
    const bool last = constraint + 1 == all.size() || all[constraint + 1].to != to;
    return last && snap(to).kind == SnapKind::end;
  }

  void add_activities() {
    std::vector<std::size_t> start_of_activity;
    std::map<std::size_t, std::size_t> end_of;
    for (std::size_t i = 0; i < steps_.steps.size(); ++i) {
      if (snap(i).kind == SnapKind::end) {
        end_of[steps_.start_of[i]] = i;
      } else if (snap(i).kind != SnapKind::timed_literal) {
        start_of_activity.push_back(i);
        end_of[i] = i;
      }
    }
    std::ranges::stable_sort(start_of_activity, {},
                             [&](std::size_t step) { return plan_.network.points[point(step)].earliest; });
    for (const std::size_t start : start_of_activity) add_activity(start, end_of[start]);
  }

  void add_activity(std::size_t start, std::size_t end) {
    const std::size_t index = plan_.activities.size();
    const ActionId id = snap(start).action;
    Activity activity;
    activity.durative = start != end;
    activity.start_point = point(start);
    activity.end_point = point(end);
    auto& points = plan_.network.points;
    points[activity.start_point].activity = points[activity.end_point].activity = index;
    activity.start = points[activity.start_point].earliest;
    activity.end = points[activity.end_point].earliest;
    activity.max_duration = activity.durative ? no_bound : Duration{0};
    if (const auto duration = duration_to_.find(activity.end_point); duration != duration_to_.end()) {
      activity.min_duration = plan_.network.constraints[duration->second].lower;
      activity.max_duration = plan_.network.constraints[duration->second].upper;
    }
    for (const ObjectId object : task_.action_arguments[id]) {
      activity.arguments.push_back(task_.objects[object.index()]);
    }
    activity.name = task_.schemas[task_.actions[id].schema.index()];
    if (!served_.empty()) activity.goals_served = std::move(served_[start]);
    if (describes_) describe(task_.actions[id].schema, activity);
    plan_.makespan = std::max(plan_.makespan, activity.end);
    plan_.activities.push_back(std::move(activity));
  }

  // Schemas are numbered as lower_actions() orders them: plain actions, then durative ones.
  void describe(SchemaId schema, Activity& activity) const {
    const auto instance_of = [&](const std::vector<pddl::TypedName>& parameters) {
      std::map<std::string, std::string> variables;
      for (std::size_t i = 0; i < parameters.size(); ++i)
        variables[parameters[i].name] = activity.arguments[i];
      return Substitution(grounding_.symbols, grounding_.constants, std::move(variables));
    };
    if (schema.index() < domain_.actions.size()) {
      const pddl::Action& action = domain_.actions[schema.index()];
      activity.at_start = instance_of(action.parameters).conditions(action.precondition);
      activity.start_effects = instance_of(action.parameters).effects(action.effects);
      return;
    }
    const pddl::DurativeAction& action = domain_.durative_actions[schema.index() - domain_.actions.size()];
    const Substitution ground = instance_of(action.parameters);
    activity.at_start = ground.conditions(action.condition.at_start);
    activity.over_all = ground.conditions(action.condition.over_all);
    activity.at_end = ground.conditions(action.condition.at_end);
    activity.start_effects = ground.effects(action.start_effects);
    activity.end_effects = ground.effects(action.end_effects);
  }

  const pddl::Domain& domain_;
  const Grounding& grounding_;
  const Task& task_;
  const PlanPrefix& steps_;
  std::span<const NamedGoal> goals_;
  std::vector<std::vector<std::size_t>> served_;  // by step of a start
  bool describes_;
  TemporalCheck check_;
  std::map<std::size_t, std::size_t> duration_to_;  // by point of an end: index of the constraint
  std::vector<TimeWindow> windows_;                 // by step: the window in which the schedule puts it
  Plan plan_;
};

}  // namespace

Plan build_plan(const pddl::Domain& domain, const Grounding& grounding, const PlanPrefix& steps,
                const Options& options, std::span<const NamedGoal> goals) {
  return PlanBuilder(domain, grounding, steps, options, goals).run();
}

}  // namespace roci::planner::temporal_pddl::extraction
