#include "exec_svc/executive/decision_points.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace roci::exec::executive {

using temporal::bounded;
using temporal::DecisionChoice;
using temporal::DecisionPoint;
using temporal::Time;
using temporal::TimePoint;

DecisionPoints::DecisionPoints(RunState& state, StartWaits& waits)
    : state_(&state),
      waits_(&waits),
      asked_at_(state.plan.decisions.size()),
      held_by_(state.plan.decisions.size()),
      asked_by_(state.plan.decisions.size()) {
  for (std::size_t d = 0; d < state.plan.decisions.size(); ++d) {
    const DecisionPoint& decision = state.plan.decisions[d];
    open_.insert(d);
    std::set<TimePoint> held;
    for (const DecisionChoice& choice : decision.choices)
      for (const std::string& id : choice.activities)
        held.insert(state.plan.activities[state.index_of.at(id)].start_point);
    if (held.empty()) held.insert(decision.decide_before);
    asked_by_[d].assign(held.begin(), held.end());
    held.insert(decision.decide_before);
    for (const TimePoint point : asked_by_[d]) {
      const auto& together = state.points.precedence().together[point];
      held.insert(together.begin(), together.end());
    }
    held_by_[d].assign(held.begin(), held.end());
    for (const TimePoint point : held) state.points.hold(point);
  }
}

bool DecisionPoints::take_answer(const DecisionAnswer& answer, Time now) {
  const auto asked = std::find_if(open_.begin(), open_.end(), [&](std::size_t d) {
    return state_->plan.decisions[d].id == answer.decision;
  });
  if (!state_->starting() || asked == open_.end() || !asked_at_[*asked]) return false;
  const std::size_t index = *asked;
  const DecisionPoint& decision = state_->plan.decisions[index];
  const auto chosen =
      std::find_if(decision.choices.begin(), decision.choices.end(),
                   [&](const DecisionChoice& choice) { return choice.name == answer.choice; });
  if (chosen == decision.choices.end() || now > answer_before(index)) return false;
  open_.erase(asked);
  const std::set<std::string> wanted(chosen->activities.begin(), chosen->activities.end());
  std::set<std::string> unwanted;
  for (const DecisionChoice& choice : decision.choices)
    for (const std::string& id : choice.activities)
      if (!wanted.contains(id)) unwanted.insert(id);
  for (const std::string& id : unwanted) {
    const Index activity = state_->index_of.at(id);
    if (state_->runs[activity].phase == ActivityPhase::waiting)
      state_->skip(activity, "decision " + decision.id + ": " + answer.choice);
  }
  for (const TimePoint point : held_by_[index]) {
    state_->points.release(point);
    const PointOwner& owner = state_->points.owner(point);
    if (owner.role == PointRole::start) waits_->consider(owner.activity, now);
  }
  return true;
}

bool DecisionPoints::ask(Time now) {
  if (!state_->starting()) return false;
  bool progress = false;
  for (const std::size_t d : open_) {
    const DecisionPoint& decision = state_->plan.decisions[d];
    if (asked_at_[d]) {
      if (now > answer_before(d) || state_->points.happened_at(decision.decide_before))
        state_->break_plan(Breakage::decision_missing, decision.id,
                           "no answer from " + decision.resolver + " in time", "");
      continue;
    }
    const auto due = [this](TimePoint point) { return state_->points.only_held(point); };
    if (std::none_of(asked_by_[d].begin(), asked_by_[d].end(), due)) continue;
    asked_at_[d] = now;
    DecisionRequest request{decision.id, decision.resolver, {}, answer_before(d)};
    for (const DecisionChoice& choice : decision.choices) request.choices.push_back(choice.name);
    state_->outputs.decision_requests.push_back(std::move(request));
    progress = true;
  }
  return progress;
}

Time DecisionPoints::next_timer(Time now) const {
  Time next = temporal::no_bound;
  for (const std::size_t d : open_) {
    if (!asked_at_[d]) continue;
    const Time missing = answer_before(d) + temporal::Duration{1};
    if (missing > now) next = std::min(next, missing);
  }
  return next;
}

Time DecisionPoints::answer_before(std::size_t decision) const {
  const Time latest = state_->points.window(state_->plan.decisions[decision].decide_before).upper;
  return bounded(latest) ? latest : temporal::plus(*asked_at_[decision], state_->settings.decision_timeout);
}

}  // namespace roci::exec::executive
