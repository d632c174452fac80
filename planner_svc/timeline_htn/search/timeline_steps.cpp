// Steps that let a timeline grow: states on the way to the one that is wanted, that one itself, or one that is there.
#include "planner_svc/timeline_htn/search/partial_plan.hpp"

namespace roci::planner::timeline_htn::search {

using model::StateKind;

// Appends a value to its timeline, and its needs to what is urgent. Returns kNone where time does not permit it.
Index PartialPlan::append(StateId state, Index activity, Index cause) {
  const Instance& instance = ground_->at(state);
  const Index component = instance.state.component;
  const auto token = static_cast<Index>(tokens_.size());
  const Token& last = tokens_[current_[component]];
  const StateKind kind = ground_->at(last.state).kind;
  const bool at_once = last.mends && kind != StateKind::resting && kind != StateKind::error;
  Token added{state, last.end, network_.add_point(), activity, current_[component], cause};
  added.mends = is_mending(cause) || (at_once && instance.kind != StateKind::complex);
  const TimePoint start = added.start;
  tokens_.push_back(added);
  set(Field::current, component, token);
  const model::Bounds& bounds = activity == kNone ? instance.bounds : activities_[activity].bounds;
  if (!constrain(start, tokens_.back().end, bounds.shortest, bounds.longest)) return kNone;
  for (std::size_t need = ground_->definition(state).needs.size(); need > 0; --need)
    push({UrgentKind::need, token, static_cast<Index>(need - 1), kNone, 0, kNone});
  return token;
}

// What is done for a goal begins no sooner than the goal is released. Parts lie within what they are parts of, and a
// state to rest in is nothing that is done.
bool PartialPlan::wait_for_release(Index activity) {
  const Index goal = goal_of(activity);
  if (goal == kNone || ground_->at(activities_[activity].state).kind == StateKind::resting) return true;
  const Duration release = ground_->model().problem->goals[goal].release;
  return release == Duration{0} || constrain(0, activities_[activity].start, release);
}

// A step on the way to a goal begins after all that mends errors, unless its timeline can do nothing else.
bool PartialPlan::wait_for_mending(Index activity, Index token) {
  if (tokens_[token].mends) return true;
  for (Index mending = 0; mending < mending_.size(); ++mending)
    if (!constrain(activities_[mending].end, activities_[activity].start, Duration{0})) return false;
  return true;
}

// Appends a state that stands between two others, on the way to what the cause asks for.
bool PartialPlan::step_between(StateId state, Index cause, Index parent, bool complex_permitted) {
  const StateKind kind = ground_->at(state).kind;
  if (kind == StateKind::resting) return append(state, kNone, cause) != kNone;
  if (kind == StateKind::complex && !complex_permitted) return false;
  const Index activity = add_activity(state, parent);
  if (activity == kNone) return false;
  activities_[activity].placed = true;
  if (cause != kNone) activities_[activity].goal = activities_[cause].goal;
  if (!wait_for_release(activity)) return false;
  const Index token = append(state, activity, cause);
  if (token == kNone || !wait_for_mending(activity, token)) return false;
  activities_[activity].token = token;
  if (!constrain(tokens_[token].start, activities_[activity].start, Duration{0}, Duration{0}) ||
      !constrain(tokens_[token].end, activities_[activity].end, Duration{0}, Duration{0}))
    return false;
  if (kind != StateKind::complex) return true;
  activities_[activity].open_parts = 1;
  if (parent != kNone) set(Field::parts, parent, activities_[parent].open_parts + 1);
  push({UrgentKind::decompose, activity, 0, kNone, 0, kNone});
  return true;
}

// The state that the activity wants is there already, as this value.
bool PartialPlan::attach(Index activity, Index index) {
  const Token& token = tokens_[index];
  if (!constrain(token.start, activities_[activity].start, Duration{0}) ||
      !constrain(activities_[activity].end, token.end, Duration{0}))
    return false;
  set(Field::token, activity, index);
  place(activity);
  finish(activity);
  return true;
}

// A state on the way to the one that the activity wants.
bool PartialPlan::pass(Index activity, StateId state) {
  if (activities_[activity].path_from == kNone)
    set(Field::path, activity, static_cast<Index>(tokens_.size()));
  return step_between(state, activity, activities_[activity].parent, true);
}

// The next state on the way to the one that the activity wants, which may be that itself.
bool PartialPlan::go_on(Index activity, StateId state) {
  const Activity wanted = activities_[activity];
  if (state != wanted.state) return pass(activity, state);
  if (ground_->at(state).kind == StateKind::resting)
    return append(state, kNone, activity) != kNone && attach(activity, current_[component(activity)]);
  const Index token = append(state, activity, activity);
  if (token == kNone || !constrain(tokens_[token].start, wanted.start, Duration{0}, Duration{0}) ||
      !constrain(tokens_[token].end, wanted.end, Duration{0}, Duration{0}))
    return false;
  set(Field::token, activity, token);
  place(activity);
  if (ground_->at(state).kind == StateKind::complex) {
    set(Field::parts, activity, 1);
    push({UrgentKind::decompose, activity, 0, kNone, 0, kNone});
  } else {
    finish(activity);
  }
  return true;
}

}  // namespace roci::planner::timeline_htn::search
