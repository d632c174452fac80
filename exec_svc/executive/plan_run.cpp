#include "exec_svc/executive/plan_run.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

PlanRun::PlanRun(temporal::FlexiblePlan plan, const ExecutiveSettings& settings,
                 const Permissions& permissions, TimelineStore& store, std::uint64_t epoch)
    : state_(std::move(plan), settings, permissions, store, epoch) {}

// Lets an activity without a command go on that had begun at `started` when the plan was stopped.
void PlanRun::go_on(Index activity, Time started, Time now) {
  ActivityRun& run = state_.runs[activity];
  run.started = run.attempt_started = started;
  state_.store.begin(state_.plan.activities[activity]);
  state_.enter(activity, ActivityPhase::running, now);
}

void PlanRun::adopt(PlanRun& before, Time now, AfterStop stopped) {
  withdraw_what_is_gone(before);
  std::vector<std::pair<Time, TimePoint>> events;
  std::vector<Index> going_on;
  for (Index i = 0; i < state_.runs.size(); ++i) {
    const PlanActivity& planned = state_.plan.activities[i];
    const auto found = before.state_.index_of.find(planned.id);
    if (found == before.state_.index_of.end()) continue;
    const ActivityRun& run = before.state_.runs[found->second];
    const bool goes_on =
        (run.active() || run.state == ActivityState::succeeded) && run.phase != ActivityPhase::contingency;
    contingencies_.inherit(i, before.contingencies_, found->second, goes_on);
    if (!goes_on && stopped == AfterStop::goes_on && planned.owner.empty() && run.started) {
      go_on(i, *run.started, now);
      going_on.push_back(i);
      events.emplace_back(*run.started, planned.start_point);
      continue;
    }
    if (!goes_on) {
      state_.runs[i].attempt = run.attempt;
      // What is committed was promised as it stands, and so was the bound of its wait;
      // what is only planned may have another start.
      const PlanActivity& told = before.state_.plan.activities[found->second];
      const bool stands = told.commit == temporal::CommitState::committed && planned.commit == told.commit;
      if (stands && run.phase == ActivityPhase::waiting && run.wait_until) waits_.inherit(i, *run.wait_until);
      continue;
    }
    state_.runs[i] = run;
    if (run.active()) state_.active.insert(i);
    if (run.phase == ActivityPhase::done) --state_.unfinished;
    if (run.started) events.emplace_back(*run.started, planned.start_point);
    if (run.ended) events.emplace_back(*run.ended, planned.end_point);
  }
  decisions_.inherit(before.decisions_, now);
  std::sort(events.begin(), events.end());
  for (const auto& [at, point] : events) state_.points.happen(point, at);
  for (const Index activity : going_on) state_.change(activity, ActivityState::running, "goes on");
  state_.outputs.commands = std::move(before.state_.outputs.commands);
}

/// Withdraws what the new plan lacks. Contingencies do not go on under another plan.
void PlanRun::withdraw_what_is_gone(PlanRun& before) {
  for (const Index old : before.state_.active) {
    const PlanActivity& activity = before.state_.plan.activities[old];
    const ActivityPhase phase = before.state_.runs[old].phase;
    if (state_.index_of.contains(activity.id) && phase != ActivityPhase::contingency) continue;
    if (phase == ActivityPhase::contingency) {
      before.contingencies_.cancel(old);
    } else if (!activity.owner.empty() && phase != ActivityPhase::settling) {
      before.state_.send(old, CommandAction::cancel);
    }
    state_.store.end(activity, false);
  }
}

void PlanRun::advance(Time now) {
  bool progress = true;
  while (progress) {
    progress = monitor_.check(now);
    attempts_.check_order_of_ends();
    monitor_.note_overruns(now);
    progress = decisions_.ask(now) || progress;
    dispatch_.break_if_late(now);
    progress = dispatch_.let_happen(now) || progress;
    progress = dispatch_.expire_waits(now) || progress;
  }
  state_.update_outcome();
  decisions_.close();
}

void PlanRun::cancel_all(Time now) {
  if (state_.outcome.kind == OutcomeKind::finished || state_.outcome.kind == OutcomeKind::cancelled) return;
  state_.outcome.kind = OutcomeKind::cancelling;
  exchange_.withdraw_all(now);
  state_.update_outcome();
  decisions_.close();
}

bool PlanRun::drop(const std::string& activity, const std::string& reason) {
  const auto found = state_.index_of.find(activity);
  if (found == state_.index_of.end() || state_.runs[found->second].phase != ActivityPhase::waiting)
    return false;
  state_.skip(found->second, reason);
  return true;
}

bool PlanRun::contingency_under_way(const std::string& name) const {
  return std::ranges::any_of(state_.active, [&](Index activity) {
    return state_.runs[activity].phase == ActivityPhase::contingency &&
           state_.plan.activities[activity].contingency == name;
  });
}

Outputs PlanRun::take_outputs(Time now) {
  state_.outputs.outcome = state_.outcome;
  state_.outputs.next_wake = next_wake(now);
  return std::exchange(state_.outputs, {});
}

const PlanActivity* PlanRun::find(const std::string& activity) const {
  const auto found = state_.index_of.find(activity);
  return found == state_.index_of.end() ? nullptr : &state_.plan.activities[found->second];
}

std::vector<StepStatus> PlanRun::statuses() const {
  state_.points.settle();
  std::vector<StepStatus> all;
  for (Index i = 0; i < state_.runs.size(); ++i) all.push_back(state_.status(i));
  return all;
}

std::vector<StepStatus> PlanRun::upcoming(std::size_t most) const {
  std::vector<StepStatus> next;
  for (Index i = state_.first_waiting; i < state_.runs.size() && next.size() < most; ++i)
    if (state_.runs[i].state == ActivityState::waiting) next.push_back(state_.status(i));
  return next;
}

std::vector<StepStatus> PlanRun::running() const {
  std::vector<StepStatus> all;
  for (const Index i : state_.active) all.push_back(state_.status(i));
  return all;
}

std::vector<Executive::TokenStatus> PlanRun::tokens() const {
  std::vector<Executive::TokenStatus> all;
  for (const temporal::Token& token : state_.plan.tokens)
    all.push_back({state_.points.happened_at(token.start_point), state_.points.happened_at(token.end_point)});
  return all;
}

std::optional<Time> PlanRun::next_wake(Time now) {
  Time next = temporal::no_bound;
  const auto consider = [&](Time time) {
    if (time > now) next = std::min(next, time);
  };
  const OutcomeKind kind = state_.outcome.kind;
  for (const Index i : state_.active) consider(monitor_.next_timer(i, now));
  if (kind != OutcomeKind::cancelling && kind != OutcomeKind::cancelled)
    consider(state_.points.next_time(now));
  if (state_.starting()) {
    if (const auto end = waits_.next_end()) consider(*end);
    consider(decisions_.next_timer(now));
  }
  return temporal::bounded(next) ? std::optional(next) : std::nullopt;
}

}  // namespace roci::exec::executive
