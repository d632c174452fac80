// The running plan: whether it still leads to its goals, and what is given up when it does not.
#include <algorithm>

#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using executive::Breakage;
using executive::Outcome;
using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalSet;
using goals::GoalState;

using temporal::Time;

namespace {

// The goals that an activity works for: those it serves, else those of the next one that serves any.
std::vector<GoalKey> goals_behind(const temporal::FlexiblePlan& plan, const std::string& activity,
                                  const GoalSet& goals) {
  const auto failed = std::find_if(plan.activities.begin(), plan.activities.end(),
                                   [&](const temporal::PlanActivity& one) { return one.id == activity; });
  for (auto one = failed; one != plan.activities.end(); ++one) {
    std::vector<GoalKey> out;
    for (const GoalRecord* record : goals.open()) {
      const auto& served = one->goals_served;
      if (std::find(served.begin(), served.end(), record->request.key.text()) != served.end())
        out.push_back(record->request.key);
    }
    if (!out.empty()) return out;
  }
  return {};
}

}  // namespace

void Reactor::monitor_plan(Time now) {
  const Outcome outcome = executive_.outcome();
  if (outcome.kind == OutcomeKind::broken) {
    break_plan(now, (outcome.activity.empty() ? "" : outcome.activity + ": ") + outcome.reason);
    if (replan_wanted_ && outcome.breakage == Breakage::activity_failed) count_failure(now, outcome);
    if (replan_wanted_ && outcome.breakage == Breakage::refused_for_good) {
      give_up(goals_behind(executive_.plan(), outcome.activity, goals_),
              outcome.activity + " will never be taken: " + outcome.reason);
    }
  } else if (outcome.kind == OutcomeKind::finished && !background_replan_) {
    report(Severity::info, "plan.finished", "plan " + std::to_string(plan_version_) + " finished");
    phase_ = MissionPhase::idle;
    if (!goals_.open().empty()) want_plan("the plan ended with goals open");
  } else if (outcome.kind == OutcomeKind::running && !replan_wanted_) {
    check_ahead(now);
  }
}

// Conflicts of activities that are not due yet.
void Reactor::check_ahead(Time now) {
  const std::string shortfall =
      resource_monitor_.shortfall([this](const std::string& timeline) { return beliefs_.lookup(timeline); });
  if (!shortfall.empty()) return break_plan(now, shortfall);
  if (const auto conflict = conflict_monitor_.conflict(now)) {
    const auto steps = executive_.steps();
    const auto due = std::ranges::find(steps, conflict->activity, &StepStatus::activity);
    break_plan(now, conflict->activity + ", due at " + temporal::to_text(due->earliest_start) +
                        ", will lack " + conflict->description + ", and nothing in the plan brings it about");
  } else if (const auto next = conflict_monitor_.next_check()) {
    wake_at(*next);
  }
}

// The way on is what the ladder still has: a new plan, else the ground, else nothing (R102).
void Reactor::break_plan(Time now, const std::string& reason) {
  const std::string plan = "plan " + std::to_string(plan_version_);
  plan_invalid_ = true;
  report(Severity::warning, "plan.broken", plan + " is broken: " + reason);
  if (recovery_policy_.replans) {
    want_plan(plan + " is broken");
    return;
  }
  if (!recovery_policy_.asks_ground) {
    std::vector<GoalKey> open;
    for (const GoalRecord* record : goals_.open()) open.push_back(record->request.key);
    give_up(open, plan + " broke, and nothing is mended in this run: " + reason);
  }
  make_safe(now, plan + " broke: " + reason);
}

// A component that keeps failing gets ever more time to recover; in the end its goals are given up.
void Reactor::count_failure(Time now, const Outcome& outcome) {
  const temporal::PlanActivity* activity = executive_.activity(outcome.activity);
  if (activity == nullptr || activity->subsystem.empty()) return;
  const FailureBackoff::Count count = failure_backoff_.failed(activity->subsystem);
  if (count.used_up) {
    give_up(goals_behind(executive_.plan(), outcome.activity, goals_),
            activity->subsystem + " failed " + std::to_string(count.in_a_row) + " times in a row, last as " +
                outcome.activity + " " + outcome.reason);
  } else if (count.pause > temporal::Duration{0}) {
    next_call_at_ = now + count.pause;
  }
}

// Hard goals are never dropped: they fail, and the ground is asked.
void Reactor::give_up(const std::vector<GoalKey>& goals, const std::string& reason) {
  for (const GoalKey& key : goals) {
    const bool hard = goals_.find(key)->request.importance == GoalClass::hard;
    change_goal(key, hard ? GoalState::failed : GoalState::dropped, reason);
    if (hard) {
      report(Severity::error, "goal.failed",
             "hard goal " + key.text() + " failed: " + reason + "; the ground is asked");
    } else {
      report(Severity::warning, "goal.dropped", "goal " + key.text() + " dropped: " + reason);
    }
  }
}

}  // namespace roci::exec::reactor
