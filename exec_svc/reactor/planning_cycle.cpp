#include "exec_svc/reactor/planning_cycle.hpp"

#include <algorithm>
#include <utility>

#include "exec_svc/problem/problem_writer.hpp"
#include "exec_svc/reactor/plan_binding.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"
#include "exec_svc/reactor/start_times.hpp"

namespace roci::exec::reactor {

using goals::GoalRecord;
using goals::GoalState;
using problem::Forecast;
using problem::Reserves;
using temporal::Time;
using temporal::Verdict;

namespace {

std::string ending(const PlanReply& reply) {
  return std::string("planner call ended as ") + to_string(reply.verdict) +
         (reply.reason.empty() ? "" : ": " + reply.reason);
}

}  // namespace

void PlanningCycle::begin(Time now) {
  state_->replan_wanted = false;  // the problem holds all that is known now
  if (state_->goals.open().empty()) {
    state_->phase = MissionPhase::idle;
    return;
  }
  state_->phase = MissionPhase::planning;
  relaxed_.soft_goals_left_out.clear();
  relaxed_.suspect.reset();
  trials_ = {};
  call_for_now(now);
}

void PlanningCycle::call_for_now(Time now) { call(now, now + state_->mission->planner.allowance, {}); }

problem::Problem PlanningCycle::write(Time now, Time origin, const Forecast& forecast) const {
  const bool all_goals = relaxed_.soft_goals_left_out.empty();
  goals::GoalSet goals = all_goals ? state_->goals : hard_goals(state_->goals);
  if (relaxed_.suspect) goals = without(goals, *relaxed_.suspect);
  for (const goals::GoalKey& key : trials_.without) goals = without(goals, key);
  return write_problem(*state_->mission, state_->beliefs, goals, call_->next_name(), now, origin,
                       relaxed_.reserves, forecast);
}

void PlanningCycle::call(Time now, Time origin, const Forecast& forecast) {
  PlanRequest request;
  request.problem_name = call_->next_name();
  request.origin = origin;
  request.problem = write(now, origin, forecast);
  if (leave_out(request.problem)) request.problem = write(now, origin, forecast);
  request.remaining = plan_->remaining();
  call_->send(std::move(request));
}

bool PlanningCycle::leave_out(const problem::Problem& problem) {
  for (const problem::LeftOut& part : problem.left_out)
    state_->report(Severity::warning, "fact.left_out",
                   part.part + " is no part of the planner's problem: " + part.why);
  for (const problem::UnusableGoal& goal : problem.unusable_goals)
    state_->give_up({goal.key}, "the planner cannot be asked for it: " + goal.why);
  return !problem.unusable_goals.empty();
}

bool PlanningCycle::suspect_a_goal(Time now, const PlanReply& reply) {
  if (!relaxed_.suspect) relaxed_.refusal = reply.reason;
  relaxed_.suspect = next_suspect(state_->goals, relaxed_.suspect);
  if (!relaxed_.suspect) return false;
  state_->report(Severity::warning, "goal.suspected",
                 "the planner calls the problem invalid: " + reply.reason +
                     "; it is asked again without goal " + relaxed_.suspect->text());
  call_for_now(now);
  return true;
}

void PlanningCycle::take_reply(Time now, const PlanReply& reply) {
  if (call_->is_end_of_cancelled(reply) || call_->count_as_stale(reply)) return begin(now);
  call_->note_fresh();
  if (reply.verdict == Verdict::invalid_input && suspect_a_goal(now, reply)) return;
  const bool accepted = reply.verdict == Verdict::solved || speaks_of_goals(reply.verdict);
  if (accepted && relaxed_.suspect) {
    if (!is_final(state_->goals.find(*relaxed_.suspect)->state))
      state_->give_up({*relaxed_.suspect},
                      "the planner calls every problem with it invalid: " + relaxed_.refusal);
    return begin(now);
  }
  if (doubts(now, reply)) return await_retry();
  if (accepted && !trials_.without.empty()) {
    take_trial(now, reply);
  } else if (reply.verdict == Verdict::solved && !relaxed_.soft_goals_left_out.empty()) {
    state_->give_up({*state_->goals.drop_candidate()}, relaxed_.soft_goals_left_out);
    begin(now);
  } else if (reply.verdict == Verdict::solved) {
    adopt(now, reply);
  } else if (speaks_of_goals(reply.verdict)) {
    call_->clear_failures();
    if (relax(reply)) {
      begin(now);
    } else {
      call_for_now(now);
    }
  } else {
    try_again_later(now, reply);
  }
}

void PlanningCycle::adopt(Time now, const PlanReply& reply) {
  call_->clear_failures();
  call_->note_fresh();
  if (!reply.plan.activities.empty()) {
    planned_without_activities_.clear();
  } else if (give_up_unseen()) {
    return begin(now);
  }
  temporal::FlexiblePlan plan = reply.plan;
  plan.origin = call_->request().origin;
  std::vector<PlannedAction> planned;  // what is left of a plan is told as PDDL actions
  if (state_->mission->has_domain()) planned = planned_actions(plan);
  std::string fault =
      bind_plan(plan, plan_->version() + 1, *state_->mission, call_->request().problem, state_->beliefs);
  if (!recovery_policy_of(state_->mission->executive.recovery).flexible) make_inflexible(plan);
  if (fault.empty()) set_start_times(plan);
  if (fault.empty()) fault = plan_->load(plan, now);
  if (!fault.empty()) return safing_->make_safe(now, "the planner's plan cannot be executed: " + fault);
  for (std::size_t i = 0; i < planned.size(); ++i) planned[i].activity = plan.activities[i].id;
  plan_->keep_actions(std::move(planned));
  note_planned();
  plan_->begin(now);
}

void PlanningCycle::set_start_times(temporal::FlexiblePlan& plan) const {
  if (state_->authority.level() == mission::AutonomyLevel::e2) {
    fix_starts(plan);
  } else if (state_->mission->executive.start == executive::StartPolicy::latest) {
    prefer_latest_starts(plan);
  }
}

bool PlanningCycle::give_up_unseen() {
  std::vector<goals::GoalKey> unseen;
  for (const goals::GoalKey& key : state_->open_goals()) {
    if (std::ranges::count(planned_without_activities_, key) > 0) {
      unseen.push_back(key);
    } else {
      planned_without_activities_.push_back(key);
    }
  }
  std::erase_if(planned_without_activities_,
                [&](const goals::GoalKey& key) { return std::ranges::count(unseen, key) > 0; });
  state_->give_up(
      unseen,
      "the planner finds it achieved, and nothing that is observed says so: no state of a component or of a "
      "family stands for its facts in mission.yaml");
  return !unseen.empty();
}

/// Marks every open goal as planned, since the planner was asked for all of them.
void PlanningCycle::note_planned() {
  std::string served;
  for (const GoalRecord* record : state_->goals.open()) {
    const goals::GoalKey key = record->request.key;
    served += (served.empty() ? "" : ", ") + key.id;
    state_->set_goal(key, GoalState::planned, "in " + plan_->name(), plan_->version());
  }
  state_->report(Severity::info, "plan.adopted",
                 plan_->name() + " with " + std::to_string(plan_->executive().plan().activities.size()) +
                     " activities for " + served);
}

bool PlanningCycle::relax(const PlanReply& reply) {
  const RelaxationStep step = reactor::relax(reply, state_->goals, *state_->mission, relaxed_);
  switch (step.kind) {
    case RelaxationStep::Kind::give_up_soft:
      for (const auto& [goal, reason] : step.goals) state_->give_up({goal}, reason);
      return true;
    case RelaxationStep::Kind::give_up_hard:
      if (try_without_some(reply)) return false;
      give_up_hard(step);
      return true;
    case RelaxationStep::Kind::leave_out_soft:
      relaxed_.soft_goals_left_out = step.reason;
      return false;
    case RelaxationStep::Kind::spend_reserves:
      relaxed_.reserves = Reserves::spent;
      state_->report(Severity::warning, "reserve.spent",
                     "what is kept back is now used, before hard goal " + step.goals.front().goal.text() +
                         " is given up: " + first_line(step.goals.front().reason));
      return true;
  }
  return true;
}

void PlanningCycle::give_up_hard(const RelaxationStep& step) {
  for (const auto& [goal, reason] : step.goals) state_->give_up({goal}, reason);
  keep_reserves();
}

bool PlanningCycle::try_without_some(const PlanReply& refusal) {
  const std::uint32_t most = state_->mission->executive.hard_goal_trials;
  const auto at_stake = hard_goals_at_stake(refusal, state_->goals);
  auto next = next_trial(state_->goals, at_stake, trials_.made, most);
  if (next.empty()) return false;
  std::string names;
  for (const goals::GoalKey& key : next) names += (names.empty() ? "" : ", ") + key.text();
  state_->report(
      Severity::info, "goal.weighed",
      "the planner is asked without " + names + ", to see whether the other hard goals have a plan then");
  trials_ = {std::move(next), trials_.made + 1, refusal};
  return true;
}

void PlanningCycle::take_trial(Time now, const PlanReply& reply) {
  call_->clear_failures();
  const HardGoalTrials trial = trials_;
  if (reply.verdict != Verdict::solved && try_without_some(trial.refusal)) return call_for_now(now);
  if (reply.verdict == Verdict::solved) {
    for (const goals::GoalKey& key : trial.without)
      if (!is_final(state_->goals.find(key)->state))
        state_->give_up({key}, with_what_it_saves(reason_to_leave(trial.refusal, state_->goals,
                                                                  *state_->mission, key, relaxed_)));
    keep_reserves();
  } else {
    give_up_hard(reactor::relax(trial.refusal, state_->goals, *state_->mission, relaxed_));
  }
  begin(now);
}

bool PlanningCycle::soft_goal_would_leave(const PlanReply& reply) const {
  return soft_goal_to_give_up(reply, state_->goals, relaxed_).has_value();
}

bool PlanningCycle::doubts(Time now, const PlanReply& reply) {
  if (!speaks_of_goals(reply.verdict) || !call_->is_blind()) return false;
  if (!call_->back_off(now)) {
    call_->forget_lost();
    return false;
  }
  const std::string away = call_->away();
  tell_retry(first_line(ending(reply)) + "; what it was told of may be old, as " +
             (away.empty() ? "a service was away that observes it" : away + " is away"));
  return true;
}

void PlanningCycle::try_again_later(Time now, const PlanReply& reply) {
  const std::string what = ending(reply);
  const bool may_pass = reply.verdict != Verdict::unsupported && reply.verdict != Verdict::invalid_input;
  if (!may_pass || !call_->back_off(now)) return safing_->make_safe(now, what);
  tell_retry(what);
  await_retry();
}

void PlanningCycle::tell_retry(const std::string& reason) {
  state_->report(Severity::warning, "plan.retry", reason + "; will be tried again");
}

void PlanningCycle::await_retry() {
  state_->phase = MissionPhase::idle;
  state_->want_plan("the planner call is tried again");
  state_->wake_at(call_->not_before());
}

}  // namespace roci::exec::reactor
