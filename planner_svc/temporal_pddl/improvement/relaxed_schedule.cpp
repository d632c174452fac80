#include "planner_svc/temporal_pddl/improvement/relaxed_schedule.hpp"

#include <algorithm>
#include <functional>

namespace roci::planner::temporal_pddl::improvement {

using constraints::ReleaseTimes;
using heuristics::EvaluationContext, heuristics::PropositionId;
using task::Action, task::ActionId, task::FactId, task::Goal, task::Snap, task::SnapId, task::SnapKind,
    task::Task, task::TimeWindow, task::TimedStep, task::VariableId;
using temporal::Duration, temporal::no_bound;

RelaxedSchedule::RelaxedSchedule(const Task& task)
    : task_(task),
      relaxed_(task),
      facts_(relaxed_.propositions()),
      at_first_(relaxed_.operators()),
      needed_(relaxed_.propositions(), false),
      in_plan_(relaxed_.operators(), false),
      times_(relaxed_.operators(), no_bound),
      free_from_(task.layout.variables().size(), Duration{0}) {
  for (std::size_t i = 0; i < relaxed_.operators(); ++i)
    at_first_[SnapId(i)].open = static_cast<std::uint32_t>(relaxed_.needs(SnapId(i)).size());
}

Duration RelaxedSchedule::measure(const EvaluationContext& context) {
  plan_.clear();
  preferred_.clear();
  to_support_.clear();
  needed_.assign(needed_.size(), false);
  in_plan_.assign(in_plan_.size(), false);
  explore(context);
  const Goal* goal = soonest_goal();
  if (!goal) return no_bound;
  for (const FactId fact : goal->facts) need(relaxed_.proposition(fact));
  for (const ActionId action : context.running) include(task_.actions[action].end);
  while (!to_support_.empty()) {
    const PropositionId supported = to_support_.back();
    to_support_.pop_back();
    include(facts_[supported].by);
  }
  find_preferred();
  return schedule();
}

void RelaxedSchedule::reach(PropositionId proposition, Duration time, SnapId by) {
  if (facts_[proposition].time <= time) return;
  facts_[proposition] = {time, by};
  queue_.emplace_back(time, proposition);
  std::ranges::push_heap(queue_, std::greater{});
}

// Returns the first time from `ready` on at which windows allow the step, or no_bound.
Duration RelaxedSchedule::fit(SnapId op, Duration ready) const {
  if (task_.windows[op].empty()) return ready;
  const TimeWindow* window = window_from(task_.windows[op], ready);
  return window ? std::max(ready, window->open) : no_bound;
}

void RelaxedSchedule::fire(SnapId op, const ReleaseTimes& release_times) {
  Duration time = operators_[op].ready;
  for (const VariableId variable : task_.writes[op]) time = std::max(time, release_times.to_change(variable));
  time = fit(op, time);
  if (time == no_bound || time > limit_) return;
  times_[op] = time;
  for (const PropositionId added : relaxed_.adds(op)) reach(added, time, op);
}

// Goes in order of time, until a goal is reached: what comes later serves nothing.
void RelaxedSchedule::explore(const EvaluationContext& context) {
  const ReleaseTimes& release_times = *context.release_times;
  facts_.assign(facts_.size(), Fact{});
  times_.assign(times_.size(), no_bound);
  operators_ = at_first_;
  queue_.clear();
  relaxed_.each_fact(task_, context.state, [&](FactId fact) {
    reach(relaxed_.proposition(fact), release_times.to_read(task_.variable(fact)), SnapId());
  });
  for (std::size_t i = 0; i < context.running.size(); ++i)
    reach(relaxed_.running(context.running[i]), context.started[i], SnapId());
  for (std::size_t i = context.timed_done; i < task_.timed_steps.size(); ++i) {
    const TimedStep& timed = task_.timed_steps[i];
    times_[timed.snap] = timed.time;
    for (const PropositionId added : relaxed_.adds(timed.snap)) reach(added, timed.time, timed.snap);
  }
  for (const SnapId op : relaxed_.free()) fire(op, release_times);
  for (std::size_t settled_at = 0; !queue_.empty();) {
    std::ranges::pop_heap(queue_, std::greater{});
    const auto [time, proposition] = queue_.back();
    queue_.pop_back();
    if (time > facts_[proposition].time) continue;
    if (context.running.empty() && ++settled_at % 64 == 0 &&
        std::ranges::any_of(task_.goals, [&](const Goal& goal) { return settled(goal, time); }))
      return;
    for (const SnapId op : relaxed_.needed_by(proposition)) {
      const Snap& snap = task_.snaps[op];
      const bool follows_start = snap.kind == SnapKind::end && proposition == relaxed_.running(snap.action);
      const Duration least = follows_start ? task_.actions[snap.action].min_duration : Duration{0};
      operators_[op].ready = std::max(operators_[op].ready, time + least);
      if (--operators_[op].open == 0) fire(op, release_times);
    }
  }
}

bool RelaxedSchedule::settled(const Goal& goal, Duration now) const {
  return std::ranges::all_of(goal.facts,
                             [&](FactId fact) { return facts_[relaxed_.proposition(fact)].time <= now; });
}

const Goal* RelaxedSchedule::soonest_goal() const {
  const Goal* best = nullptr;
  Duration best_time = no_bound;
  for (const Goal& goal : task_.goals) {
    Duration time{0};
    for (const FactId fact : goal.facts) time = std::max(time, facts_[relaxed_.proposition(fact)].time);
    if (time >= best_time) continue;
    best = &goal;
    best_time = time;
  }
  return best;
}

void RelaxedSchedule::need(PropositionId proposition) {
  if (needed_[proposition] || facts_[proposition].by.is_none()) return;
  needed_[proposition] = true;
  to_support_.push_back(proposition);
}

void RelaxedSchedule::include(SnapId op) {
  if (in_plan_[op] || times_[op] == no_bound) return;
  in_plan_[op] = true;
  plan_.push_back(op);
  for (const PropositionId needed : relaxed_.needs(op)) need(needed);
  if (task_.snaps[op].kind == SnapKind::start) include(task_.actions[task_.snaps[op].action].end);
}

void RelaxedSchedule::find_preferred() {
  for (const SnapId op : plan_) {
    const SnapKind kind = task_.snaps[op].kind;
    if (kind == SnapKind::derivation || kind == SnapKind::timed_literal) continue;
    if (std::ranges::all_of(relaxed_.needs(op),
                            [&](PropositionId needed) { return facts_[needed].by.is_none(); }))
      preferred_.push_back(op);
  }
}

Duration RelaxedSchedule::schedule() {
  for (const std::size_t variable : occupied_) free_from_[variable] = Duration{0};
  occupied_.clear();
  std::ranges::stable_sort(plan_, {}, [&](SnapId op) { return times_[op]; });
  Duration finish{0};
  for (const SnapId op : plan_) finish = std::max(finish, place(op));
  std::ranges::stable_sort(plan_, {}, [&](SnapId op) { return times_[op]; });
  return finish;
}

// Places the step after what it needs and when its variables are free. Returns when its action ends.
Duration RelaxedSchedule::place(SnapId op) {
  const Snap& snap = task_.snaps[op];
  if (snap.kind == SnapKind::timed_literal || snap.kind == SnapKind::derivation) return Duration{0};
  Duration& time = times_[op];
  for (const PropositionId needed : relaxed_.needs(op)) {
    if (!facts_[needed].by.is_none()) time = std::max(time, times_[facts_[needed].by]);
  }
  if (snap.kind == SnapKind::end) return time;
  const Action& action = task_.actions[snap.action];
  const auto each_variable = [&](const auto& visit) {
    for (const SnapId step : {action.start, action.end}) {
      for (const FactId fact : task_.adds[step]) visit(task_.layout.variable_of(fact));
      for (const FactId fact : task_.deletes[step]) visit(task_.layout.variable_of(fact));
    }
  };
  each_variable([&](std::size_t variable) { time = std::max(time, free_from_[variable]); });
  const Duration end = time + action.min_duration;
  each_variable([&](std::size_t variable) {
    free_from_[variable] = end;
    occupied_.push_back(variable);
  });
  if (!action.instantaneous() && times_[action.end] != no_bound)
    times_[action.end] = std::max(times_[action.end], end);
  return end;
}

}  // namespace roci::planner::temporal_pddl::improvement
