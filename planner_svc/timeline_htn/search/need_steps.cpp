// Steps that meet what a value needs of other timelines, or what a behaviour asks of one that is predicted.
#include "planner_svc/timeline_htn/search/partial_plan.hpp"

namespace roci::planner::timeline_htn::search {

using model::NeedKind;

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

}  // namespace roci::planner::timeline_htn::search
