#include "planner_svc/timeline_htn/search/partial_plan.hpp"

#include <algorithm>

namespace roci::planner::timeline_htn::search {

using model::StateKind;

std::vector<Index> PartialPlan::predicted(Index component) const {
  std::vector<Index> out;
  for (Index token = begun_[component]; token <= current_[component]; ++token) out.push_back(token);
  return out;
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

bool PartialPlan::is_mending(Index activity) const {
  while (activity != kNone && activities_[activity].parent != kNone) activity = activities_[activity].parent;
  return activity != kNone && activity < mending_.size();
}

bool PartialPlan::take(const Step& step) {
  obstacle_ = {};
  const std::size_t before = changes_.size();
  if (apply(step) && leaves_time(before)) return true;
  if (obstacle_.kind != Obstacle::Kind::none) return false;
  const bool placing = step.kind == StepKind::attach || step.kind == StepKind::append ||
                       step.kind == StepKind::pass || step.kind == StepKind::decompose;
  return refuse({Obstacle::Kind::time, placing ? goal_of(step.subject) : kNone,
                 placing ? activities_[step.subject].state : kNone, kNone, kNone, kNone});
}

// Whether what is still to come about on the timelines that have grown since then may begin behind their last values.
bool PartialPlan::leaves_time(std::size_t changes) {
  for (std::size_t i = changes; i < changes_.size(); ++i) {
    if (changes_[i].field != Field::current) continue;
    const Token& last = tokens_[current_[changes_[i].index]];
    for (const Index index : open_) {
      const Activity& one = activities_[index];
      if (one.nested || component(index) != changes_[i].index) continue;
      const bool rests = ground_->at(one.state).kind == StateKind::resting;
      // It may be met by a value before, if it waited for others or is a part of what did (Successors::attach_back).
      if (rests && (one.parent != kNone || one.before_begin < one.before_end)) continue;
      if (!may_begin_after(index, rests && last.state == one.state ? last.start : last.end))
        return refuse({Obstacle::Kind::time, goal_of(index), one.state, kNone, kNone, kNone});
    }
  }
  return true;
}

// The constraint is not kept: those of the value that the activity will have say it, too.
bool PartialPlan::may_begin_after(Index activity, TimePoint point) {
  const Network::Mark mark = network_.mark();
  const bool out = constrain(point, activities_[activity].start, Duration{0});
  network_.take_back(mark);
  return out;
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
