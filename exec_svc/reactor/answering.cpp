// Reactor: what follows from the planner's answer. A plan is adopted, a goal gives way (R52, R53), or the
// call is made again.
#include <algorithm>

#include "exec_svc/reactor/plan_binding.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalSet;
using goals::GoalState;
using mission::FluentSource;
using mission::WindowModel;
using problem::goal_facts;
using problem::Reserves;

using temporal::Time;

bool speaks_of_goals(PlanVerdict verdict) {
  return verdict == PlanVerdict::unsolvable || verdict == PlanVerdict::timeout ||
         verdict == PlanVerdict::out_of_memory;
}

void Reactor::take_answer(Time now, const PlanAnswer& answer) {
  if (is_end_of_cancelled_call(answer) || count_as_outdated(answer)) {
    begin_planning(now);
    return;
  }
  outdated_calls_ = 0;
  if (answer.verdict == PlanVerdict::solved && !suspicion_.empty()) {
    give_up({*goals_.drop_candidate()}, suspicion_);
    begin_planning(now);
  } else if (answer.verdict == PlanVerdict::solved) {
    adopt(now, answer);
  } else if (speaks_of_goals(answer.verdict)) {
    failed_calls_ = 0;
    if (give_way(answer)) {
      begin_planning(now);
    } else {
      call_planner(now, now + mission_->planner.allowance, {});
    }
  } else {
    try_again_later(now, answer);
  }
}

void Reactor::adopt(Time now, const PlanAnswer& answer) {
  failed_calls_ = 0;
  outdated_calls_ = 0;
  temporal::FlexiblePlan plan = answer.plan;
  plan.origin = call_.origin;
  std::vector<PlannedAction> planned = planned_actions(plan);
  std::string fault = bind_plan(plan, plan_version_ + 1, *mission_, call_.problem, beliefs_, goals_);
  if (!ladder_.flexible) make_inflexible(plan);
  if (fault.empty()) {
    const auto faults = executive_.load(plan, now);
    if (!faults.empty()) fault = faults.front();
  }
  if (!fault.empty()) {
    make_safe(now, "the planner's plan cannot be executed: " + fault);
    return;
  }
  for (std::size_t i = 0; i < planned.size(); ++i) planned[i].activity = plan.activities[i].id;
  planned_ = std::move(planned);
  ++plan_version_;
  first_plan_ = false;
  margins_ = Margins(plan);
  std::set<std::string> foreseen;
  for (const WindowModel& window : mission_->windows) foreseen.insert(window.fact);
  foresight_ = Foresight(plan, foreseen, mission_->executive.ack_timeout);
  std::string served;
  for (const GoalRecord* record : goals_.open()) {
    const GoalKey key = record->request.key;
    served += (served.empty() ? "" : ", ") + key.id;
    goals_.set_state(key, GoalState::planned, "in plan " + std::to_string(plan_version_), plan_version_);
    out_.goal_changes.push_back(*goals_.find(key));
  }
  note(NoteLevel::info, "plan.adopted",
       "plan " + std::to_string(plan_version_) + " with " + std::to_string(plan.activities.size()) +
           " activities for " + served);
  begin_plan(now, std::move(plan));
}

void Reactor::begin_plan(Time now, temporal::FlexiblePlan plan) {
  phase_ = MissionPhase::executing;
  condition_values_.clear();
  for (const temporal::PlanActivity& activity : plan.activities) {
    for (const temporal::Condition* condition : {&activity.pre, &activity.maintenance}) {
      for (const std::string& name : temporal::timelines_of(*condition)) condition_values_[name] = {};
    }
  }
  out_.adopted = std::move(plan);
  told_starts_.clear();
  tell_windows();
  wake_at(now);
}

// What the planner proves out of reach takes no other goal with it. One goal leaves at a time, unless hard
// ones alone are named: the others may be within reach once it is gone. A proof that names hard goals alone
// may hold only because of what the soft ones demand (a search leaves out what cannot serve all goals): one
// more call, without them, tells.
bool Reactor::give_way(const PlanAnswer& answer) {
  const bool proved = answer.verdict == PlanVerdict::unsolvable;
  const std::string why = std::string(proved ? "proved that not all goals fit" : to_string(answer.verdict)) +
                          (answer.reason.empty() ? "" : ": " + answer.reason);
  const std::vector<GoalKey> named = goals_to_blame(answer);
  if (const auto soft = soft_goal_to_leave(answer)) {
    give_up({*soft}, why);
  } else if (!named.empty() && suspicion_.empty() && goals_.drop_candidate()) {
    suspicion_ = why;
    return false;
  } else {
    const auto hard = named.empty() ? std::vector{newest_hard()} : named;
    if (!spend_reserves(hard, why)) {
      give_up(hard, why);
      reserves_ = Reserves::kept;  // the goals that remain may not need them
    }
  }
  return true;
}

GoalKey Reactor::newest_hard() const {
  GoalKey out;
  for (const GoalRecord* record : goals_.open())
    if (record->request.importance == GoalClass::hard) out = record->request.key;
  return out;
}

// The goals as they are, but soft ones that are open count as gone.
GoalSet Reactor::hard_goals() const {
  GoalSet out = goals_;
  for (const GoalRecord* record : goals_.open())
    if (record->request.importance != GoalClass::hard)
      out.set_state(record->request.key, GoalState::dropped, "");
  return out;
}

std::vector<GoalKey> Reactor::goals_to_blame(const PlanAnswer& answer) const {
  return answer.verdict == PlanVerdict::unsolvable ? named_goals(answer.reason) : std::vector<GoalKey>{};
}

std::optional<GoalKey> Reactor::soft_goal_to_leave(const PlanAnswer& answer) const {
  const std::vector<GoalKey> named = goals_to_blame(answer);
  const bool of_hard_alone = answer.verdict == PlanVerdict::unsolvable && !suspicion_.empty();
  return named.empty() && !of_hard_alone ? goals_.drop_candidate() : goals_.drop_candidate(named);
}

// Before hard goals go, what the mission keeps back is offered to one more call; false if there is nothing
// left to offer.
bool Reactor::spend_reserves(const std::vector<GoalKey>& leaving, const std::string& why) {
  const bool any = std::any_of(mission_->fluents.begin(), mission_->fluents.end(),
                               [](const FluentSource& source) { return source.last.has_value(); });
  if (!any || reserves_ == Reserves::spent) return false;
  reserves_ = Reserves::spent;
  note(NoteLevel::warning, "reserve.spent",
       "what is kept back is now used, before hard goal " + leaving.front().text() + " is given up: " + why);
  return true;
}

// Open goals of which a fact stands in the planner's reason.
std::vector<GoalKey> Reactor::named_goals(const std::string& reason) const {
  std::vector<GoalKey> out;
  for (const GoalRecord* record : goals_.open()) {
    const auto facts = goal_facts(*mission_, record->request);
    const auto named = [&](const std::string& fact) { return reason.find(fact) != std::string::npos; };
    if (std::any_of(facts.begin(), facts.end(), named)) out.push_back(record->request.key);
  }
  return out;
}

void Reactor::try_again_later(Time now, const PlanAnswer& answer) {
  const std::string what = std::string("planner call ended as ") + to_string(answer.verdict) +
                           (answer.reason.empty() ? "" : ": " + answer.reason);
  const bool may_pass =
      answer.verdict != PlanVerdict::unsupported && answer.verdict != PlanVerdict::invalid_input;
  if (!may_pass || ++failed_calls_ > mission_->executive.call_retries) {
    make_safe(now, what);
    return;
  }
  note(NoteLevel::warning, "plan.retry", what + "; will be tried again");
  phase_ = MissionPhase::idle;
  not_before_ = now + temporal::seconds(5.0 * static_cast<double>(1U << std::min(failed_calls_, 5U)));
  want_plan("the planner call is tried again");
  wake_at(not_before_);
}

}  // namespace roci::exec::reactor
