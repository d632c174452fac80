#include "exec_svc/executive/plan_run.hpp"

#include <algorithm>

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::bounded;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

PlanRun::PlanRun(temporal::FlexiblePlan plan, const ExecutiveSettings& settings, TimelineStore& store)
    : plan_(std::move(plan)),
      settings_(settings),
      store_(store),
      points_(plan_, settings.start == StartPolicy::latest, settings.only_committed),
      runs_(plan_.activities.size()),
      decisions_(plan_.decisions.size()),
      held_by_(plan_.decisions.size()),
      asked_by_(plan_.decisions.size()),
      tokens_from_(plan_.activities.size()),
      unfinished_(plan_.activities.size()) {
  outcome_.kind = OutcomeKind::running;
  for (Index i = 0; i < plan_.activities.size(); ++i) index_of_[plan_.activities[i].id] = i;
  for (std::size_t t = 0; t < plan_.tokens.size(); ++t) {
    const PointOwner& owner = points_.owner(plan_.tokens[t].start_point);
    if (owner.role == PointRole::start) tokens_from_[owner.activity].push_back(t);
  }
  for (Index d = 0; d < plan_.decisions.size(); ++d) {
    open_decisions_.insert(d);
    std::set<TimePoint> held;
    for (const temporal::DecisionChoice& choice : plan_.decisions[d].choices)
      for (const std::string& id : choice.activities)
        held.insert(plan_.activities[index_of_.at(id)].start_point);
    if (held.empty()) held.insert(plan_.decisions[d].decide_before);
    asked_by_[d].assign(held.begin(), held.end());
    held.insert(plan_.decisions[d].decide_before);
    for (const TimePoint point : asked_by_[d]) {
      const auto& together = points_.precedence().together[point];
      held.insert(together.begin(), together.end());
    }
    held_by_[d].assign(held.begin(), held.end());
    for (const TimePoint point : held) points_.hold(point);
  }
}

void PlanRun::adopt(PlanRun& before) {
  std::vector<std::pair<Time, TimePoint>> events;
  for (const Index old : before.active_) {
    const PlanActivity& activity = before.plan_.activities[old];
    if (index_of_.contains(activity.id) && before.runs_[old].phase != ActivityPhase::contingency) continue;
    if (before.runs_[old].phase == ActivityPhase::contingency) {
      before.send_contingency(old, CommandAction::cancel);
    } else if (!activity.owner.empty() && before.runs_[old].phase != ActivityPhase::settling) {
      before.send(old, CommandAction::cancel);
    }
    store_.end(activity, false);
  }
  for (Index i = 0; i < runs_.size(); ++i) {
    const auto found = before.index_of_.find(plan_.activities[i].id);
    if (found == before.index_of_.end()) continue;
    const ActivityRun& run = before.runs_[found->second];
    if ((!run.active() && run.state != ActivityState::succeeded) || run.phase == ActivityPhase::contingency) {
      runs_[i].attempt = run.attempt;
      runs_[i].contingency_commands = run.contingency_commands;
      continue;
    }
    runs_[i] = run;
    if (run.active()) active_.insert(i);
    if (run.phase == ActivityPhase::done) --unfinished_;
    if (run.started) events.emplace_back(*run.started, plan_.activities[i].start_point);
    if (run.ended) events.emplace_back(*run.ended, plan_.activities[i].end_point);
  }
  std::sort(events.begin(), events.end());
  for (const auto& [at, point] : events) points_.happen(point, at);
  outputs_.commands = std::move(before.outputs_.commands);
}

void PlanRun::advance(Time now) {
  bool progress = true;
  while (progress) {
    progress = monitor(now);
    break_if_disordered();
    note_overruns(now);
    progress = decide(now) || progress;
    break_if_late(now);
    progress = dispatch(now) || progress;
    progress = expire_waits(now) || progress;
  }
  update_outcome();
}

void PlanRun::cancel_all(Time now) {
  if (outcome_.kind == OutcomeKind::finished || outcome_.kind == OutcomeKind::cancelled) return;
  outcome_.kind = OutcomeKind::cancelling;
  for (Index i = 0; i < runs_.size(); ++i) {
    ActivityRun& run = runs_[i];
    const bool owner_works = run.phase == ActivityPhase::sent || run.phase == ActivityPhase::running;
    if (run.phase == ActivityPhase::done) continue;
    if (run.phase == ActivityPhase::cancelling) {
      if (run.after_cancel == AfterCancel::retry) run.after_cancel = AfterCancel::withdraw;
    } else if (owner_works && !plan_.activities[i].owner.empty()) {
      cancel(i, now, AfterCancel::withdraw, "cancel requested");
    } else {
      if (run.phase == ActivityPhase::contingency) send_contingency(i, CommandAction::cancel);
      close(i, now, ActivityState::cancelled,
            run.phase == ActivityPhase::settling ? "cancelled before its end was confirmed" : "");
    }
  }
  update_outcome();
}

Outputs PlanRun::take_outputs(Time now) {
  outputs_.outcome = outcome_;
  outputs_.next_wake = next_wake(now);
  return std::exchange(outputs_, {});
}

const PlanActivity* PlanRun::find(const std::string& activity) const {
  const auto found = index_of_.find(activity);
  return found == index_of_.end() ? nullptr : &plan_.activities[found->second];
}

StepStatus PlanRun::status(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  const temporal::Window window = points_.window(planned.start_point);
  return {planned.id,   planned.name, run.attempt, run.state, window.lower,
          window.upper, run.started,  run.ended,   run.reason};
}

std::vector<StepStatus> PlanRun::statuses() const {
  points_.settle();
  std::vector<StepStatus> all;
  for (Index i = 0; i < runs_.size(); ++i) all.push_back(status(i));
  return all;
}

std::vector<StepStatus> PlanRun::upcoming(std::size_t most) const {
  std::vector<StepStatus> next;
  for (Index i = first_waiting_; i < runs_.size() && next.size() < most; ++i)
    if (runs_[i].state == ActivityState::waiting) next.push_back(status(i));
  return next;
}

std::vector<StepStatus> PlanRun::running() const {
  std::vector<StepStatus> all;
  for (const Index i : active_) all.push_back(status(i));
  return all;
}

std::vector<Executive::TokenStatus> PlanRun::tokens() const {
  std::vector<Executive::TokenStatus> all;
  for (const temporal::Token& token : plan_.tokens)
    all.push_back({points_.happened_at(token.start_point), points_.happened_at(token.end_point)});
  return all;
}

/// The first reason stands.
void PlanRun::break_plan(Breakage breakage, const std::string& who, const std::string& reason,
                         const std::string& contingency) {
  if (outcome_.kind == OutcomeKind::running)
    outcome_ = {OutcomeKind::broken, breakage, who, reason, contingency};
}

void PlanRun::update_outcome() {
  if (outcome_.kind == OutcomeKind::running && unfinished_ == 0) outcome_.kind = OutcomeKind::finished;
  if (outcome_.kind == OutcomeKind::cancelling && active_.empty()) outcome_.kind = OutcomeKind::cancelled;
}

std::optional<Time> PlanRun::next_wake(Time now) {
  Time next = temporal::no_bound;
  const auto consider = [&](Time time) {
    if (time > now) next = std::min(next, time);
  };
  for (const Index i : active_) consider(next_timer(i, now));
  if (outcome_.kind != OutcomeKind::cancelling && outcome_.kind != OutcomeKind::cancelled)
    consider(points_.next_time(now));
  if (starting()) {
    if (!waits_.empty()) consider(waits_.begin()->first);
    for (const Index d : open_decisions_)
      if (decisions_[d]) consider(answer_before(d) + temporal::Duration{1});
  }
  return bounded(next) ? std::optional(next) : std::nullopt;
}

void PlanRun::change(Index activity, ActivityState state, std::string reason) {
  runs_[activity].state = state;
  runs_[activity].reason = std::move(reason);
  while (first_waiting_ < runs_.size() && runs_[first_waiting_].state != ActivityState::waiting)
    ++first_waiting_;
  outputs_.changes.push_back(status(activity));
}

void PlanRun::enter(Index activity, ActivityPhase phase, Time now) {
  ActivityRun& run = runs_[activity];
  if (run.wait_until) waits_.erase({*run.wait_until, activity});
  if (phase == ActivityPhase::done && run.phase != ActivityPhase::done) --unfinished_;
  run.phase = phase;
  run.phase_since = now;
  if (run.active()) {
    active_.insert(activity);
  } else {
    active_.erase(activity);
  }
}

void PlanRun::send(Index activity, CommandAction action) {
  const PlanActivity& planned = plan_.activities[activity];
  outputs_.commands.push_back({action, planned.id, runs_[activity].attempt, planned.owner, planned.subsystem,
                               planned.command_name, planned.arguments, points_.duration(activity).lower});
}

void PlanRun::recover(RecoveryAction action, Index activity, std::string reason) {
  outputs_.recoveries.push_back({action, plan_.activities[activity].id, std::move(reason)});
}

temporal::Lookup PlanRun::lookup() const {
  return [this](const std::string& timeline) { return store_.value_of(timeline); };
}

}  // namespace roci::exec::executive
