#include "planner_svc/timeline_htn/search/partial_plan.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::GroundState, model::NeedKind, model::Pattern, model::Problem, model::StateKind,
    model::Term;
using temporal::no_bound;

std::vector<Index> admissible(const Ground& ground, const Behaviour& behaviour, Index variable,
                              std::vector<Index> objects) {
  std::vector<Index> out;
  objects[variable] = kNone;
  for (const auto& bound : ground.bindings(behaviour.variables, std::move(objects), behaviour.where))
    out.push_back(bound[variable]);
  return out;
}

Index Bindings::number(const std::vector<Index>& objects) {
  const auto [entry, added] = numbers_.emplace(objects, static_cast<Index>(all_.size()));
  if (added) {
    all_.push_back(objects);
    bytes_ += 120 + 8 * objects.size();
  }
  return entry->second;
}

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
    sound_ = constrain(0, start, goal.opens, goal.closes);
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

std::vector<Index> PartialPlan::predicted(Index component) const {
  std::vector<Index> out;
  for (Index token = begun_[component]; token <= current_[component]; ++token) out.push_back(token);
  return out;
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

PartialPlan::Mark PartialPlan::mark() const {
  return {network_.mark(), tokens_.size(), activities_.size(),
          urgents_.size(), before_.size(), changes_.size()};
}

void PartialPlan::take_back(const Mark& mark) {
  while (changes_.size() > mark.changes) {
    const Change change = changes_.back();
    changes_.pop_back();
    if (change.field == Field::opened) {
      open_.pop_back();
    } else if (change.field == Field::closed) {
      open_.insert(open_.begin() + change.index, change.before);
    } else if (change.field == Field::placed) {
      activities_[change.index].placed = change.before != 0;
    } else {
      slot(change.field, change.index) = change.before;
    }
  }
  network_.take_back(mark.network);
  tokens_.resize(mark.tokens);
  activities_.resize(mark.activities);
  urgents_.resize(mark.urgent);
  before_.resize(mark.before);
}

Index& PartialPlan::slot(Field field, Index index) {
  switch (field) {
    case Field::current:
      return current_[index];
    case Field::token:
      return activities_[index].token;
    case Field::behaviour:
      return activities_[index].behaviour;
    case Field::binding:
      return activities_[index].binding;
    case Field::parts:
      return activities_[index].open_parts;
    case Field::path:
      return activities_[index].path_from;
    case Field::ended:
      return tokens_[index].ended;
    case Field::window:
      return windows_[index];
    default:
      return urgent_;
  }
}

void PartialPlan::set(Field field, Index index, Index value) {
  Index& place = slot(field, index);
  changes_.push_back({field, index, place});
  place = value;
}

bool PartialPlan::constrain(TimePoint from, TimePoint to, Duration lower, Duration upper) {
  if (network_.add(from, to, lower, upper)) return true;
  ++refusals_by_time_;
  return false;
}

Index PartialPlan::add_activity(StateId state, Index parent, const model::Bounds* bounds) {
  Activity activity;
  activity.state = state;
  activity.parent = parent;
  activity.start = network_.add_point();
  activity.end = network_.add_point();
  if (state != kNone && ground_->at(state).kind == StateKind::simple)
    activity.bounds = ground_->at(state).bounds;
  if (bounds != nullptr) activity.bounds = *bounds;
  activities_.push_back(activity);
  const bool lasts =
      constrain(activity.start, activity.end, activity.bounds.shortest, activity.bounds.longest);
  return lasts ? static_cast<Index>(activities_.size() - 1) : kNone;
}

void PartialPlan::push(Urgent item) {
  item.below = urgent_;
  urgents_.push_back(item);
  set(Field::urgent, 0, static_cast<Index>(urgents_.size() - 1));
}

void PartialPlan::pop() { set(Field::urgent, 0, urgents_[urgent_].below); }

void PartialPlan::open_up(Index activity) {
  open_.push_back(activity);
  changes_.push_back({Field::opened, 0, 0});
}

// Takes the activity off the open ones.
void PartialPlan::place(Index activity) {
  const auto found = std::ranges::find(open_, activity);
  changes_.push_back({Field::closed, static_cast<Index>(found - open_.begin()), activity});
  open_.erase(found);
  changes_.push_back({Field::placed, activity, 0});
  activities_[activity].placed = true;
}

// The activity is complete: so may be those above it.
void PartialPlan::finish(Index activity) {
  for (Index parent = activities_[activity].parent; parent != kNone; parent = activities_[parent].parent) {
    set(Field::parts, parent, activities_[parent].open_parts - 1);
    if (activities_[parent].open_parts > 0) return;
  }
}

std::vector<Index> PartialPlan::before(Index activity) const {
  return {before_.begin() + activities_[activity].before_begin,
          before_.begin() + activities_[activity].before_end};
}

bool PartialPlan::ready(Index activity) const {
  const Activity& one = activities_[activity];
  for (Index i = one.before_begin; i < one.before_end; ++i)
    if (!complete(before_[i])) return false;
  if (one.nested) return true;
  const Index running = tokens_[current_[component(activity)]].activity;
  return running == kNone || complete(running);
}

bool PartialPlan::passed(Index component, StateId state, Index path_from) const {
  for (Index token = current_[component]; token != kNone && token >= path_from; token = tokens_[token].before)
    if (tokens_[token].state == state) return true;
  return false;
}

bool PartialPlan::passed_to_rest(Index component, StateId state) const {
  for (Index token = current_[component]; token != begun_[component] && tokens_[token].cause == kNone;
       token = tokens_[token].before)
    if (tokens_[token].state == state) return true;
  return false;
}

std::vector<Index> PartialPlan::need_variables(Index token) const {
  std::vector<Index> out = ground_->at(tokens_[token].state).state.objects;
  out.resize(out.size() + ground_->definition(tokens_[token].state).free.size(), kNone);
  return out;
}

Index PartialPlan::goal_of(Index activity) const {
  while (activity != kNone && activities_[activity].parent != kNone) activity = activities_[activity].parent;
  return activity == kNone ? kNone : activities_[activity].goal;
}

bool PartialPlan::refuse(Obstacle obstacle) {
  obstacle_ = obstacle;
  return false;
}

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

bool PartialPlan::is_mending(Index activity) const {
  while (activity != kNone && activities_[activity].parent != kNone) activity = activities_[activity].parent;
  return activity != kNone && activity < mending_.size();
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

bool PartialPlan::meet_need(Index needing, Index need, Index other) {
  const Token& one = tokens_[needing];
  const Token& met = tokens_[other];
  switch (ground_->definition(one.state).needs[need].kind) {
    case NeedKind::during:
      return constrain(met.start, one.start, Duration{0}) && constrain(one.end, met.end, Duration{0});
    case NeedKind::at_start:
      return constrain(met.start, one.start, Duration{0}) && constrain(one.start, met.end, Duration{0});
    case NeedKind::met_by:
      if (met.ended == 0 && !ground_->is_predicted(ground_->at(met.state).state.component))
        set(Field::ended, other, 1);
      return constrain(met.end, one.start, Duration{0}, Duration{0});
  }
  return false;
}

bool PartialPlan::path_to_need(StateId state, bool passing) {
  const Urgent item = urgents_[urgent_];
  pop();
  const Index cause = tokens_[item.subject].cause;
  const Index parent = cause == kNone ? kNone : activities_[cause].parent;
  const Index component = ground_->at(state).state.component;
  const bool there = state == item.goal && !passing;
  if (!there) push(item);
  if (!step_between(state, cause, parent, false)) return false;
  return !there || meet_need(item.subject, item.need, current_[component]);
}

// Lets what needs a predicted state, or is to begin in one, do so at the time of this one.
bool PartialPlan::take_window(const Step& step) {
  const bool condition = step.kind == StepKind::condition_here;
  pop();
  set(Field::window, ground_->at(tokens_[step.first].state).state.component, step.first);
  if (!condition) {
    if (meet_need(step.subject, step.second, step.first)) return true;
    return refuse({Obstacle::Kind::window, goal_of(tokens_[step.subject].cause), tokens_[step.subject].state,
                   kNone, step.second, kNone});
  }
  const Activity& one = activities_[step.subject];
  if (constrain(tokens_[step.first].start, one.start, Duration{0}) &&
      constrain(one.start, tokens_[step.first].end, Duration{0}))
    return true;
  return refuse(
      {Obstacle::Kind::window, goal_of(step.subject), one.state, one.behaviour, step.second, kNone});
}

bool PartialPlan::take(const Step& step) {
  obstacle_ = {};
  if (apply(step)) return true;
  if (obstacle_.kind != Obstacle::Kind::none) return false;
  const bool placing = step.kind == StepKind::attach || step.kind == StepKind::append ||
                       step.kind == StepKind::pass || step.kind == StepKind::decompose;
  return refuse({Obstacle::Kind::time, placing ? goal_of(step.subject) : kNone,
                 placing ? activities_[step.subject].state : kNone, kNone, kNone, kNone});
}

bool PartialPlan::apply(const Step& step) {
  switch (step.kind) {
    case StepKind::attach:
      return attach(step.subject, step.first);
    case StepKind::append:
      return go_on(step.subject, step.first);
    case StepKind::pass:
      return pass(step.subject, step.first);
    case StepKind::decompose:
      return decompose(step.subject, step.first, step.second);
    case StepKind::path_to_need:
      return path_to_need(step.first, false);
    case StepKind::pass_to_need:
      return path_to_need(step.first, true);
    case StepKind::rest:
      return step_between(step.first, kNone, kNone, false);
    case StepKind::nest:
      place(step.subject);
      set(Field::parts, step.subject, 1);
      push({UrgentKind::decompose, step.subject, 0, kNone, 0, kNone});
      return true;
    case StepKind::condition_here:
      return take_window(step);
    case StepKind::need_here:
      if (ground_->is_predicted(ground_->at(tokens_[step.first].state).state.component))
        return take_window(step);
      pop();
      return meet_need(step.subject, step.second, step.first);
    case StepKind::need_path:
      pop();
      push({UrgentKind::path_to_need, step.subject, step.second, step.first,
            static_cast<Index>(tokens_.size()), kNone});
      return true;
  }
  return false;
}

bool PartialPlan::close() {
  const Duration horizon = ground_->model().problem->horizon;
  return std::ranges::all_of(current_,
                             [&](Index token) { return constrain(0, tokens_[token].end, horizon, horizon); });
}

std::size_t PartialPlan::bytes() const {
  return network_.bytes() + tokens_.capacity() * sizeof(Token) + activities_.capacity() * sizeof(Activity) +
         urgents_.capacity() * sizeof(Urgent) + (before_.capacity() + open_.capacity()) * sizeof(Index) +
         changes_.capacity() * sizeof(Change);
}

}  // namespace roci::planner::timeline_htn::search
