// Open choices of sufficient plans (R131): asked when the information may exist, bound by the resolver's
// answer.
#include <algorithm>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::bounded;
using temporal::DecisionChoice;
using temporal::DecisionPoint;
using temporal::plus;
using temporal::Time;
using temporal::TimePoint;

bool PlanRun::take_answer(const DecisionAnswer& answer, Time now) {
  const auto asked = std::find_if(open_decisions_.begin(), open_decisions_.end(),
                                  [&](Index d) { return plan_.decisions[d].id == answer.decision; });
  if (!starting() || asked == open_decisions_.end() || !decisions_[*asked]) return false;
  const Index index = *asked;
  const DecisionPoint& decision = plan_.decisions[index];
  const auto chosen =
      std::find_if(decision.choices.begin(), decision.choices.end(),
                   [&](const DecisionChoice& choice) { return choice.name == answer.choice; });
  if (chosen == decision.choices.end() || now > answer_before(index)) return false;
  open_decisions_.erase(asked);
  const std::set<std::string> wanted(chosen->activities.begin(), chosen->activities.end());
  std::set<std::string> unwanted;
  for (const DecisionChoice& choice : decision.choices)
    for (const std::string& id : choice.activities)
      if (!wanted.contains(id)) unwanted.insert(id);
  for (const std::string& id : unwanted)
    if (runs_[index_of_.at(id)].phase == ActivityPhase::waiting)
      skip(index_of_.at(id), "decision " + decision.id + ": " + answer.choice);
  for (const TimePoint point : held_by_[index]) {
    points_.release(point);
    if (points_.owner(point).role == PointRole::start) consider_wait(points_.owner(point).activity, now);
  }
  return true;
}

/// Asks as soon as every predecessor of some activity of the choices has happened.
bool PlanRun::decide(Time now) {
  if (!starting()) return false;
  bool progress = false;
  const std::set<Index> open = open_decisions_;
  for (const Index d : open) {
    const DecisionPoint& decision = plan_.decisions[d];
    if (decisions_[d]) {
      if (now > answer_before(d) || points_.happened_at(decision.decide_before))
        break_plan(Breakage::decision_missing, decision.id,
                   "no answer from " + decision.resolver + " in time", "");
      continue;
    }
    const auto& asked_by = asked_by_[d];
    if (std::none_of(asked_by.begin(), asked_by.end(), [&](TimePoint p) { return points_.only_held(p); }))
      continue;
    decisions_[d] = now;
    DecisionRequest request{decision.id, decision.resolver, {}, answer_before(d)};
    for (const DecisionChoice& choice : decision.choices) request.choices.push_back(choice.name);
    outputs_.decision_requests.push_back(std::move(request));
    progress = true;
  }
  return progress;
}

Time PlanRun::answer_before(Index decision) const {
  const Time latest = points_.window(plan_.decisions[decision].decide_before).upper;
  return bounded(latest) ? latest : plus(*decisions_[decision], settings_.decision_timeout);
}

}  // namespace roci::exec::executive
