// Steps that give a complex state one of its behaviours: its conditions, its parts and the time between them.
#include <algorithm>

#include "planner_svc/timeline_htn/search/partial_plan.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::Pattern, model::StateKind, model::Term;
using temporal::no_bound;

// Lets the timeline go on by itself, through states without a command, until the condition holds.
bool PartialPlan::follow(Index component, const Pattern& pattern, const std::vector<Index>& objects,
                         Index activity) {
  std::vector<StateId> path;
  StateId state = current_state(component);
  if (ground_->at(state).kind != StateKind::simple) return false;
  while (!ground_->fits(state, pattern, objects)) {
    if (path.size() == kStepsByItself) return false;
    StateId chosen = kNone;
    for (const StateId after : ground_->next(state)) {
      const bool by_itself =
          !ground_->definition(after).command && ground_->at(after).kind != StateKind::complex;
      if (by_itself && (chosen == kNone || ground_->fits(after, pattern, objects))) {
        chosen = after;
        if (ground_->fits(after, pattern, objects)) break;
      }
    }
    if (chosen == kNone) return false;
    path.push_back(state = chosen);
  }
  return std::ranges::all_of(
      path, [&](StateId one) { return step_between(one, activity, activities_[activity].parent, false); });
}

bool PartialPlan::conditions_hold(Index activity, const Behaviour& behaviour,
                                  const std::vector<Index>& objects) {
  for (Index i = 0; i < behaviour.conditions.size(); ++i) {
    const model::Precondition& condition = behaviour.conditions[i];
    const Index component = condition.state.component;
    if (ground_->is_predicted(component)) {
      push({UrgentKind::condition, activity, i, kNone, 0, kNone});
      continue;
    }
    const Index own = activities_[activity].token;
    const bool before_itself = own != kNone && ground_->at(tokens_[own].state).state.component == component;
    const Index looked_at = before_itself ? tokens_[own].before : current_[component];
    bool holds = ground_->fits(tokens_[looked_at].state, condition.state, objects) != condition.negated;
    if (!holds && !condition.negated && !before_itself)
      holds = follow(component, condition.state, objects, activity);
    if (!holds)
      return refuse({Obstacle::Kind::condition, goal_of(activity), activities_[activity].state,
                     static_cast<Index>(&behaviour - ground_->model().behaviours.data()), i,
                     tokens_[looked_at].state});
    if (before_itself) continue;
    const Token& token = tokens_[current_[component]];
    if (!constrain(token.start, activities_[activity].start, Duration{0}) ||
        !constrain(activities_[activity].start, token.end, Duration{0}))
      return false;
  }
  return true;
}

bool PartialPlan::decompose(Index activity, Index behaviour_index, Index binding) {
  const Behaviour& behaviour = ground_->model().behaviours[behaviour_index];
  const std::vector<Index>& objects = bindings_->at(binding);
  pop();
  set(Field::behaviour, activity, behaviour_index);
  set(Field::binding, activity, binding);
  if (!conditions_hold(activity, behaviour, objects)) return false;
  const auto first = static_cast<Index>(activities_.size());
  if (!add_parts(activity, behaviour, objects)) return false;
  if (!add_part_constraints(activity, behaviour, objects, first))
    return refuse({Obstacle::Kind::time, goal_of(activity), activities_[activity].state, behaviour_index,
                   kNone, kNone});
  return std::ranges::all_of(behaviour.decisions, [&](const model::Decision& decision) {
    return !decision.over || add_choices(activity, behaviour, decision, objects, first);
  });
}

// What is done first of each object that the plan does not reckon with stands beside the
// timelines, behind the decision.
bool PartialPlan::add_choices(Index activity, const Behaviour& behaviour, const model::Decision& decision,
                              const std::vector<Index>& objects, Index first) {
  const Activity& at = activities_[decision.before.subgoal ? first + *decision.before.subgoal : activity];
  const TimePoint point = decision.before.end ? at.end : at.start;
  for (const Index object : admissible(*ground_, behaviour, *decision.variable, objects)) {
    if (object == objects[*decision.variable]) continue;
    std::vector<Index> other = objects;
    other[*decision.variable] = object;
    std::vector<StateId> states;
    for (const Index subgoal : decision.subgoals)
      states.push_back(ground_->find(ground_of(behaviour.subgoals[subgoal].state, other)));
    if (std::ranges::find(states, kNone) != states.end()) continue;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Index part = add_activity(states[i], activity);
      if (part == kNone) return false;
      activities_[part].subgoal = decision.subgoals[i];
      activities_[part].choice = object;
      activities_[part].beside = activities_[part].placed = true;
      if (!constrain(point, activities_[part].start, Duration{0}) ||
          !constrain(activities_[activity].start, activities_[part].start, Duration{0}) ||
          !constrain(activities_[part].end, activities_[activity].end, Duration{0}))
        return false;
    }
  }
  return true;
}

// Bounds within which the state lasts whichever object the open variable stands for.
void PartialPlan::widen(model::Bounds& bounds, const Behaviour& behaviour, Index variable,
                        const Pattern& pattern, const std::vector<Index>& objects) {
  if (std::ranges::find(pattern.terms, Term{variable, false}) == pattern.terms.end()) return;
  for (const Index object : admissible(*ground_, behaviour, variable, objects)) {
    std::vector<Index> bound = objects;
    bound[variable] = object;
    const StateId state = ground_->find(ground_of(pattern, bound));
    if (state == kNone) continue;
    bounds.shortest = std::min(bounds.shortest, ground_->at(state).bounds.shortest);
    bounds.longest = std::max(bounds.longest, ground_->at(state).bounds.longest);
  }
}

bool PartialPlan::add_parts(Index activity, const Behaviour& behaviour, const std::vector<Index>& objects) {
  std::vector<bool> beside(behaviour.subgoals.size(), false);
  for (const model::Decision& decision : behaviour.decisions)
    for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
      for (const Index subgoal : decision.choices[choice].subgoals) beside[subgoal] = true;
  const auto own = static_cast<Index>(&behaviour - ground_->model().behaviours.data());
  Index parts = 0;
  for (Index i = 0; i < behaviour.subgoals.size(); ++i) {
    const Pattern& pattern = behaviour.subgoals[i].state;
    const StateId state = ground_->find(ground_of(pattern, objects));
    if (state == kNone)
      return refuse(
          {Obstacle::Kind::no_state, goal_of(activity), activities_[activity].state, own, i, kNone});
    const bool complex = ground_->at(state).kind == StateKind::complex;
    bool nested = false;
    for (Index above = activity; above != kNone; above = activities_[above].parent) {
      if (activities_[above].state == kNone) continue;
      if (complex && activities_[above].state == state)
        return refuse({Obstacle::Kind::recursion, goal_of(activity), state, own, i, kNone});
      nested = nested || ground_->at(activities_[above].state).state.component == pattern.component;
    }
    if (nested && !complex)
      return refuse(
          {Obstacle::Kind::no_state, goal_of(activity), activities_[activity].state, own, i, kNone});
    model::Bounds bounds = ground_->at(state).bounds;
    for (const model::Decision& decision : behaviour.decisions)
      if (decision.binds()) widen(bounds, behaviour, *decision.variable, pattern, objects);
    const Index part =
        add_activity(state, activity, ground_->at(state).kind == StateKind::simple ? &bounds : nullptr);
    if (part == kNone) return false;
    activities_[part].subgoal = i;
    activities_[part].nested = nested;
    activities_[part].beside = beside[i];
    if (!constrain(activities_[activity].start, activities_[part].start, Duration{0}) ||
        !constrain(activities_[part].end, activities_[activity].end, Duration{0}))
      return false;
    if (beside[i]) {
      activities_[part].placed = true;
    } else {
      open_up(part);
      ++parts;
    }
  }
  set(Field::parts, activity, activities_[activity].open_parts - 1 + parts);
  if (activities_[activity].open_parts == 0) finish(activity);
  return true;
}

bool PartialPlan::add_part_constraints(Index activity, const Behaviour& behaviour,
                                       const std::vector<Index>& objects, Index first) {
  const auto point = [&](const model::Point& one) {
    const Activity& owner = activities_[one.subgoal ? first + *one.subgoal : activity];
    return one.end ? owner.end : owner.start;
  };
  std::vector<std::vector<Index>> before(behaviour.subgoals.size());
  for (const model::SubgoalConstraint& constraint : behaviour.constraints) {
    const auto number = [&](const model::Expression& expression,
                            Duration otherwise) -> std::optional<Duration> {
      if (expression.empty()) return otherwise;
      const auto value = model::evaluate(ground_->model(), expression, objects);
      return value ? model::duration_of(*value) : std::nullopt;
    };
    const auto lower = number(constraint.lower, -no_bound), upper = number(constraint.upper, no_bound);
    if (!lower || !upper || !constrain(point(constraint.from), point(constraint.to), *lower, *upper))
      return false;
    const bool ordered = constraint.from.subgoal && constraint.to.subgoal && constraint.from.end &&
                         !constraint.to.end && *lower >= Duration{0};
    if (ordered && !activities_[first + *constraint.from.subgoal].beside)
      before[*constraint.to.subgoal].push_back(first + *constraint.from.subgoal);
  }
  for (Index i = 0; i < before.size(); ++i) {
    activities_[first + i].before_begin = static_cast<Index>(before_.size());
    before_.insert(before_.end(), before[i].begin(), before[i].end());
    activities_[first + i].before_end = static_cast<Index>(before_.size());
  }
  return true;
}

}  // namespace roci::planner::timeline_htn::search
