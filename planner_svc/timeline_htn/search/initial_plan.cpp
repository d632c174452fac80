// How a plan begins: the first values of the timelines and what is predicted of them, the behaviours that are
// triggered, and the goals.
#include <algorithm>
#include <utility>

#include "planner_svc/timeline_htn/search/partial_plan.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::GroundState, model::Pattern, model::Problem, model::StateKind, model::Term;

PartialPlan::PartialPlan(Ground& ground, Bindings& bindings, const std::vector<Index>& goal_order)
    : ground_(&ground), bindings_(&bindings), network_(ground.model().problem->horizon) {
  const Problem& problem = *ground.model().problem;
  for (const auto& initial : problem.initial) {
    current_.push_back(static_cast<Index>(tokens_.size()));
    const StateId state = ground.find(ground_of(*initial, {}));
    tokens_.push_back({state, temporal::origin_point, network_.add_point(), kNone, kNone});
    tokens_.back().mends = ground.at(state).kind == StateKind::simple;
    begun_.push_back(current_.back());
    static_cast<void>(constrain(0, tokens_.back().end, Duration{0}, ground.at(state).bounds.longest));
    const auto component = static_cast<Index>(begun_.size() - 1);
    if (ground.is_predicted(component)) add_predicted(component);
  }
  windows_.assign(current_.size(), kNone);
  add_mending();
  const auto mended = static_cast<Index>(activities_.size());
  std::vector<Index> activity_of(problem.goals.size(), kNone);
  for (Index i = 0; i < goal_order.size(); ++i) activity_of[goal_order[i]] = mended + i;
  for (const Index index : goal_order) {
    const model::Goal& goal = problem.goals[index];
    const Index activity = add_activity(ground.find(ground_of(goal.state, {})), kNone);
    if (activity == kNone) {
      sound_ =
          refuse({Obstacle::Kind::time, index, ground.find(ground_of(goal.state, {})), kNone, kNone, kNone});
      return;
    }
    activities_[activity].goal = index;
    activities_[activity].before_begin = static_cast<Index>(before_.size());
    for (Index mending = 0; mending < mended; ++mending) before_.push_back(mending);
    for (const Index after : goal.after) before_.push_back(activity_of[after]);
    activities_[activity].before_end = static_cast<Index>(before_.size());
    open_up(activity);
  }
  for (Index activity = mended; activity < activities_.size() && sound_; ++activity) {
    const model::Goal& goal = problem.goals[activities_[activity].goal];
    const TimePoint start = activities_[activity].start;
    sound_ = constrain(0, start, goal.opens, goal.closes) && wait_for_release(activity);
    for (const Index earlier : before(activity))
      sound_ = sound_ && constrain(activities_[earlier].end, start, Duration{0});
    if (!sound_)
      refuse({Obstacle::Kind::time, activities_[activity].goal, activities_[activity].state, kNone, kNone,
              kNone});
  }
}

// What is known to come, at its times: what needs it finds it there.
void PartialPlan::add_predicted(Index component) {
  const Problem& problem = *ground_->model().problem;
  const auto end_at = [&](Duration at) { sound_ = constrain(0, tokens_.back().end, at, at) && sound_; };
  for (const model::PredictedState& value : *problem.predicted[component]) {
    if (value.at >= problem.horizon) break;
    end_at(value.at);
    const StateId state = ground_->find(ground_of(value.state, {}));
    const TimePoint start = tokens_.back().end;
    tokens_.push_back({state, start, network_.add_point(), kNone, current_[component]});
    current_[component] = static_cast<Index>(tokens_.size() - 1);
    const model::Bounds& bounds = ground_->at(state).bounds;
    sound_ = constrain(start, tokens_.back().end, bounds.shortest, bounds.longest) && sound_;
  }
  end_at(problem.horizon);
}

// Behaviours that are triggered by where the timelines begin, or by a change of goals: one activity for each cause.
void PartialPlan::add_mending() {
  const model::Model& model = ground_->model();
  const Problem& problem = *model.problem;
  std::vector<std::vector<std::pair<Index, Index>>> causes(model.components.size() + 1);
  for (Index b = 0; b < model.behaviours.size(); ++b) {
    const Behaviour& behaviour = model.behaviours[b];
    const auto add = [&](std::size_t cause, std::vector<Index> bound) {
      for (const auto& objects : ground_->bindings(behaviour.variables, std::move(bound), behaviour.where))
        causes[cause].emplace_back(b, bindings_->number(objects));
    };
    if (behaviour.on_goal_change && problem.goals_changed)
      add(model.components.size(), std::vector<Index>(behaviour.variables.size(), kNone));
    for (const Pattern& trigger : behaviour.triggers) {
      const GroundState& begun = ground_->at(tokens_[begun_[trigger.component]].state).state;
      if (begun.state != trigger.state) continue;
      std::vector<Index> bound(behaviour.variables.size(), kNone);
      bool fits = true;
      for (std::size_t i = 0; i < trigger.terms.size() && fits; ++i) {
        const Term& term = trigger.terms[i];
        Index expected = term.object ? term.index : bound[term.index];
        if (expected == kNone) expected = bound[term.index] = begun.objects[i];
        fits = expected == begun.objects[i];
      }
      if (fits) add(trigger.component, std::move(bound));
    }
  }
  for (auto& ways : causes) {
    if (ways.empty()) continue;
    std::ranges::stable_sort(ways, [&](const auto& a, const auto& b) {
      return model.behaviours[a.first].priority > model.behaviours[b.first].priority;
    });
    const Index activity = add_activity(kNone, kNone);
    activities_[activity].placed = true;
    activities_[activity].open_parts = 1;
    mending_.push_back(std::move(ways));
  }
  for (Index activity = static_cast<Index>(activities_.size()); activity > 0; --activity)
    push({UrgentKind::decompose, activity - 1, 0, kNone, 0, kNone});
}

}  // namespace roci::planner::timeline_htn::search
