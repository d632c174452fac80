#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using constraints::LongestPathStn, constraints::StepConstraint, constraints::kNoPath;
using task::Action, task::ActionId, task::FactId, task::IdVector, task::Snap, task::SnapId, task::SnapKind,
    task::Task, task::TimeWindow;
using temporal::Duration, temporal::no_bound;

namespace {

// Moves `time` into the first window that is not over. Returns false if all are.
bool fit(std::span<const TimeWindow> windows, Duration& time, bool& changed) {
  const TimeWindow* window = window_from(windows, time);
  if (!window) return false;
  if (window->open > time) {
    time = window->open;
    changed = true;
  }
  return true;
}

}  // namespace

TemporalCheck::TemporalCheck(const Task& task, Duration epsilon)
    : task_(task), bounds_(task, epsilon), orderings_(task, epsilon), absolute_(task.has_absolute_times()) {
  IdVector<FactId, bool> invariant(task.fact_names.size(), false);
  for (std::size_t i = 0; i < task.actions.size(); ++i) {
    for (const FactId fact : task.invariants[ActionId(i)]) invariant[fact] = true;
  }
  for (const Action& action : task.actions) {
    takes_away_.push_back(
        !action.instantaneous() &&
        std::ranges::any_of(task.deletes[action.end], [&](FactId fact) { return invariant[fact]; }));
  }
}

void TemporalCheck::fill(const PlanPrefix& prefix, LongestPathStn& network) {
  network.reset(prefix.steps.size());
  for (const StepConstraint& constraint : prefix.constraints) {
    network.require(constraint.from, constraint.to, constraint.lower);
    if (constraint.upper != no_bound) {
      network.require(constraint.to, constraint.from, -constraint.upper);
    }
  }
}

LongestPathStn TemporalCheck::network(const PlanPrefix& prefix) {
  LongestPathStn result;
  fill(prefix, result);
  return result;
}

Duration TemporalCheck::upper_bound(const PlanPrefix& prefix, std::size_t step) const {
  const bool running = std::ranges::any_of(prefix.running, [&](const Running& r) { return r.step == step; });
  const Duration own = running ? bounds_.latest_running(prefix.steps[step], prefix.timed_done)
                               : bounds_.latest(prefix.steps[step], prefix.timed_done);
  return std::min(own, prefix.deadline);
}

bool TemporalCheck::fit_windows(const PlanPrefix& prefix, bool& changed) {
  for (std::size_t i = 0; i < prefix.steps.size(); ++i) {
    const auto windows = task_.windows[prefix.steps[i]];
    if (!windows.empty() && !fit(windows, times_[i], changed)) return false;
    const Snap& snap = task_.snaps[prefix.steps[i]];
    if (snap.kind != SnapKind::end || task_.span_windows[snap.action].empty()) continue;
    Duration& start = times_[prefix.start_of[i]];
    const TimeWindow* window = window_from(task_.span_windows[snap.action], times_[i]);
    if (!window) return false;
    if (start < window->open) {
      start = window->open;
      changed = true;
    }
  }
  return true;
}

bool TemporalCheck::ends_after(ActionId action, ActionId other) const {
  const SnapId end = task_.actions[action].end;
  return std::ranges::any_of(task_.invariants[other], [&](FactId fact) {
    return std::ranges::count(task_.deletes[end], fact) > 0 && std::ranges::count(task_.adds[end], fact) == 0;
  });
}

void TemporalCheck::look_ahead(const PlanPrefix& prefix) {
  const std::size_t steps = prefix.steps.size();
  network_.extend(prefix.running.size());
  times_.resize(network_.points(), Duration{0});
  for (std::size_t i = 0; i < prefix.running.size(); ++i) {
    const ActionId id = prefix.running[i].action;
    const Action& action = task_.actions[id];
    network_.require(prefix.running[i].step, steps + i, action.min_duration);
    if (action.max_duration != no_bound)
      network_.require(steps + i, prefix.running[i].step, -action.max_duration);
    for (std::size_t j = 0; j < prefix.running.size(); ++j) {
      if (i != j && ends_after(id, prefix.running[j].action))
        network_.require(steps + j, steps + i, Duration{0});
    }
    pending_.clear();
    if (takes_away_[id]) orderings_.add(prefix.steps, action.end, {}, pending_);
    for (const StepConstraint& constraint : pending_)
      network_.require(constraint.from, steps + i, constraint.lower);
  }
}

const std::vector<Duration>* TemporalCheck::earliest(const PlanPrefix& prefix) {
  fill(prefix, network_);
  times_.assign(prefix.steps.size(), Duration{0});
  if (!times_.empty()) times_[prefix.closing_step] = prefix.closing_time;
  if (!prefix.running.empty()) look_ahead(prefix);
  if (!schedule(prefix)) return nullptr;
  times_.resize(prefix.steps.size());
  return &times_;
}

bool TemporalCheck::schedule(const PlanPrefix& prefix) {
  if (!absolute_) return network_.raise(times_);
  for (bool changed = true; changed;) {
    changed = false;
    if (!fit_windows(prefix, changed)) return false;
    if (!network_.raise(times_)) return false;
    if (!fit_windows(prefix, changed)) return false;
  }
  for (std::size_t i = 0; i < prefix.steps.size(); ++i) {
    if (times_[i] > upper_bound(prefix, i)) return false;
  }
  return true;
}

std::vector<TimeWindow> TemporalCheck::chosen_windows(const PlanPrefix& prefix,
                                                      const std::vector<Duration>& times) const {
  std::vector<TimeWindow> result = widest_windows(prefix);
  const auto restrict = [](TimeWindow& window, const TimeWindow& to) {
    window.open = std::max(window.open, to.open);
    window.close = std::min(window.close, to.close);
  };
  for (std::size_t i = 0; i < times.size(); ++i) {
    const SnapId step = prefix.steps[i];
    if (!task_.windows[step].empty()) restrict(result[i], *window_from(task_.windows[step], times[i]));
    const Snap& snap = task_.snaps[step];
    if (snap.kind != SnapKind::end || task_.span_windows[snap.action].empty()) continue;
    const TimeWindow& span = *window_from(task_.span_windows[snap.action], times[i]);
    restrict(result[i], span);
    restrict(result[prefix.start_of[i]], span);
  }
  if (!result.empty()) restrict(result[prefix.closing_step], {prefix.closing_time, no_bound});
  return result;
}

std::vector<TimeWindow> TemporalCheck::widest_windows(const PlanPrefix& prefix) const {
  std::vector<TimeWindow> result(prefix.steps.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto windows = task_.windows[prefix.steps[i]];
    if (!windows.empty()) result[i] = {windows.front().open, windows.back().close};
    const Duration bound = upper_bound(prefix, i);
    if (bound != no_bound) result[i].close = std::min(result[i].close, bound);
  }
  return result;
}

// The latest times are the negated least solution of the mirrored network.
std::vector<Duration> TemporalCheck::latest(const PlanPrefix& prefix,
                                            const std::vector<TimeWindow>& windows) {
  LongestPathStn mirrored(prefix.steps.size());
  for (auto constraint = prefix.constraints.rbegin(); constraint != prefix.constraints.rend(); ++constraint) {
    mirrored.require(constraint->to, constraint->from, constraint->lower);
    if (constraint->upper != no_bound) {
      mirrored.require(constraint->from, constraint->to, -constraint->upper);
    }
  }
  std::vector<Duration> times(prefix.steps.size(), kNoPath);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (windows[i].close != no_bound) times[i] = -windows[i].close;
  }
  mirrored.raise(times);
  for (Duration& time : times) time = time == kNoPath ? no_bound : -time;
  return times;
}

}  // namespace roci::planner::temporal_pddl::search
