// Reactor: replanning while what runs goes on. The problem is written for the state that the running
// activities will leave; nothing else starts meanwhile; the plans change when they have ended, if that state
// has come about. Where the old plan must not go on, the pause follows.
#include <algorithm>

#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using temporal::Verdict;

using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalRecord;
using goals::GoalState;
using mission::Replanning;
using problem::Forecast;

namespace {

using temporal::Impact;
using temporal::ImpactKind;
using temporal::PlanActivity;
using temporal::Time;

struct Remainder {
  const PlanActivity* activity;
  Time ends;
  double part;  // of the duration, that is still to come
};

Remainder remainder_of(const PlanActivity& activity, Time started, Time now) {
  const Time ends = std::max(now, started + activity.duration_lower);
  const auto whole = static_cast<double>(activity.duration_lower.count());
  return {&activity, ends, whole > 0 ? static_cast<double>((ends - now).count()) / whole : 0.0};
}

// Amounts of fluents come little by little over an activity, whatever the domain says for simplicity.
void foresee(const Remainder& remainder, Forecast& forecast) {
  for (const temporal::ImpactWhen moment : {temporal::ImpactWhen::at_start, temporal::ImpactWhen::at_end}) {
    for (const Impact& impact : remainder.activity->impacts) {
      if (impact.moment != moment) continue;
      if (const bool* holds = std::get_if<bool>(&impact.amount)) forecast.facts[impact.timeline] = *holds;
      if (const double* amount = std::get_if<double>(&impact.amount);
          amount && impact.kind == ImpactKind::delta)
        forecast.changes[impact.timeline] += *amount * remainder.part;
    }
  }
}

}  // namespace

bool Reactor::can_replan_in_background() const {
  return mission_->executive.replanning == Replanning::background && phase_ == MissionPhase::executing &&
         !plan_invalid_ && executive_.outcome().kind == OutcomeKind::running &&
         !executive_.running().empty() && !goals_.open().empty();
}

void Reactor::begin_background_replan(Time now) {
  replan_wanted_ = false;
  report(Severity::info, "plan.wanted", replan_reason_ + "; what runs goes on");
  if (count_replan(now)) request_background_plan(now);
}

void Reactor::request_background_plan(Time now) {
  std::vector<Remainder> running;
  for (const StepStatus& step : executive_.running())
    running.push_back(remainder_of(*executive_.activity(step.activity), step.started.value_or(now), now));
  std::stable_sort(running.begin(), running.end(),
                   [](const Remainder& a, const Remainder& b) { return a.ends < b.ends; });
  background_replan_ = BackgroundReplan{};
  for (const Remainder& remainder : running) foresee(remainder, background_replan_->forecast);
  executive_.hold_starts(true);
  call_planner(now, std::max(now + mission_->planner.allowance, running.back().ends),
               background_replan_->forecast);
}

void Reactor::continue_background_replan(Time now) {
  if (plan_invalid_) {
    background_replan_.reset();
  } else if (background_replan_->reply && replan_wanted_) {
    background_replan_.reset();  // goals have changed since it was asked for
  } else if (background_replan_->reply) {
    const Verdict verdict = background_replan_->reply->verdict;
    if (verdict == Verdict::solved) return change_plans(now);
    const PlanReply reply = *std::exchange(background_replan_, std::nullopt)->reply;
    if (goals_.open().empty()) return keep_plan(now);  // what ran has achieved them
    if (is_end_of_cancelled_call(reply))
      return want_plan("a map or arm model changed during the planner call");
    if (!speaks_of_goals(verdict))
      return break_plan(now, std::string("planner call ended as ") + to_string(verdict));
    if (soft_goal_to_leave(reply)) {
      give_way(reply);
      keep_plan(now);
    } else {  // no hard goal is given up for the sake of what runs
      plan_invalid_ = true;
      want_plan("a hard goal may fit if what runs is cancelled");
    }
  }
}

// One goal less than was asked for: if the running plan serves all others, it goes on.
void Reactor::keep_plan(Time now) {
  const auto open = goals_.open();
  const bool all_served = std::all_of(open.begin(), open.end(), [this](const GoalRecord* record) {
    return record->state == GoalState::planned && record->plan_version == plan_version_;
  });
  if (all_served) {
    executive_.hold_starts(false);
    report(Severity::info, "plan.kept", "plan " + std::to_string(plan_version_) + " goes on");
    wake_at(now);
  } else if (can_replan_in_background()) {
    request_background_plan(now);
  } else {
    want_plan("without the goal that does not fit");
  }
}

void Reactor::change_plans(Time now) {
  if (!executive_.running().empty()) return;
  const std::string surprise = forecast_mismatch(background_replan_->forecast);
  if (surprise.empty() && !is_stale(*background_replan_->reply)) {
    adopt(now, *std::exchange(background_replan_, std::nullopt)->reply);
    return;
  }
  if (!background_replan_->observed_by)
    background_replan_->observed_by = now + mission_->executive.ack_timeout;
  if (!surprise.empty() && now < *background_replan_->observed_by) {
    wake_at(*background_replan_->observed_by);  // observations may follow the acknowledgement
    return;
  }
  background_replan_.reset();
  want_plan(surprise.empty() ? "a map or arm model changed during the planner call" : surprise);
}

// What has come about differently; empty if nothing has.
std::string Reactor::forecast_mismatch(const Forecast& forecast) const {
  for (const auto& [fact, holds] : forecast.facts) {
    const auto value = beliefs_.lookup(fact);
    if (value && *value != temporal::Value(holds))
      return fact + (holds ? " was foreseen and is not so" : " is still so, unforeseen");
  }
  return "";
}

}  // namespace roci::exec::reactor
