// Reactor: what follows from the planner's answer. A plan is adopted, a goal gives way (R52, R53), or the
// call is made again.
#include <algorithm>

#include "exec_svc/reactor/plan_binding.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using temporal::Verdict;

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

void Reactor::take_answer(Time now, const PlanReply& reply) {
  if (is_end_of_cancelled_call(reply) || count_as_stale(reply)) {
    begin_planning(now);
    return;
  }
  stale_calls_ = 0;
  if (reply.verdict == Verdict::solved && !soft_goals_left_out_.empty()) {
    give_up({*goals_.drop_candidate()}, soft_goals_left_out_);
    begin_planning(now);
  } else if (reply.verdict == Verdict::solved) {
    adopt(now, reply);
  } else if (speaks_of_goals(reply.verdict)) {
    failed_calls_ = 0;
    if (give_way(reply)) {
      begin_planning(now);
    } else {
      call_planner(now, now + mission_->planner.allowance, {});
    }
  } else {
    try_again_later(now, reply);
  }
}

void Reactor::adopt(Time now, const PlanReply& reply) {
  failed_calls_ = 0;
  stale_calls_ = 0;
  temporal::FlexiblePlan plan = reply.plan;
  plan.origin = call_.origin;
  std::vector<PlannedAction> planned = planned_actions(plan);
  std::string fault = bind_plan(plan, plan_version_ + 1, *mission_, call_.problem, beliefs_, goals_);
  if (!recovery_policy_.flexible) make_inflexible(plan);
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
  resource_monitor_ = ResourceMonitor(plan);
  std::set<std::string> foreseen;
  for (const WindowModel& window : mission_->windows) foreseen.insert(window.fact);
  conflict_monitor_ = ConflictMonitor(plan, foreseen, mission_->executive.ack_timeout);
  std::string served;
  for (const GoalRecord* record : goals_.open()) {
    const GoalKey key = record->request.key;
    served += (served.empty() ? "" : ", ") + key.id;
    goals_.set_state(key, GoalState::planned, "in plan " + std::to_string(plan_version_), plan_version_);
    out_.goal_changes.push_back(*goals_.find(key));
  }
  report(Severity::info, "plan.adopted",
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
  reported_starts_.clear();
  report_windows();
  wake_at(now);
}

// What the planner proves out of reach takes no other goal with it. One goal leaves at a time, unless hard
// ones alone are named: the others may be within reach once it is gone. A proof that names hard goals alone
// may hold only because of what the soft ones demand (a search leaves out what cannot serve all goals): one
// more call, without them, tells.
bool Reactor::give_way(const PlanReply& reply) {
  const bool proved = reply.verdict == Verdict::unsolvable;
  const std::string reason =
      std::string(proved ? "proved that not all goals fit" : to_string(reply.verdict)) +
      (reply.reason.empty() ? "" : ": " + reply.reason);
  const std::vector<GoalKey> named = goals_to_blame(reply);
  if (const auto soft = soft_goal_to_leave(reply)) {
    give_up({*soft}, reason);
  } else if (!named.empty() && soft_goals_left_out_.empty() && goals_.drop_candidate()) {
    soft_goals_left_out_ = reason;
    return false;
  } else {
    const auto hard = named.empty() ? std::vector{newest_hard()} : named;
    if (!spend_reserves(hard, reason)) {
      give_up(hard, reason);
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

std::vector<GoalKey> Reactor::goals_to_blame(const PlanReply& reply) const {
  return reply.verdict == Verdict::unsolvable ? named_goals(reply.reason) : std::vector<GoalKey>{};
}

std::optional<GoalKey> Reactor::soft_goal_to_leave(const PlanReply& reply) const {
  const std::vector<GoalKey> named = goals_to_blame(reply);
  const bool of_hard_alone = reply.verdict == Verdict::unsolvable && !soft_goals_left_out_.empty();
  return named.empty() && !of_hard_alone ? goals_.drop_candidate() : goals_.drop_candidate(named);
}

// Before hard goals go, what the mission keeps back is offered to one more call; false if there is nothing
// left to offer.
bool Reactor::spend_reserves(const std::vector<GoalKey>& leaving, const std::string& reason) {
  const bool any = std::any_of(mission_->fluents.begin(), mission_->fluents.end(),
                               [](const FluentSource& source) { return source.last.has_value(); });
  if (!any || reserves_ == Reserves::spent) return false;
  reserves_ = Reserves::spent;
  report(Severity::warning, "reserve.spent",
         "what is kept back is now used, before hard goal " + leaving.front().text() +
             " is given up: " + reason);
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

void Reactor::try_again_later(Time now, const PlanReply& reply) {
  const std::string what = std::string("planner call ended as ") + to_string(reply.verdict) +
                           (reply.reason.empty() ? "" : ": " + reply.reason);
  const bool may_pass = reply.verdict != Verdict::unsupported && reply.verdict != Verdict::invalid_input;
  if (!may_pass || ++failed_calls_ > mission_->executive.call_retries) {
    make_safe(now, what);
    return;
  }
  report(Severity::warning, "plan.retry", what + "; will be tried again");
  phase_ = MissionPhase::idle;
  next_call_at_ = now + temporal::seconds(5.0 * static_cast<double>(1U << std::min(failed_calls_, 5U)));
  want_plan("the planner call is tried again");
  wake_at(next_call_at_);
}

}  // namespace roci::exec::reactor
