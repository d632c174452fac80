#include "planner_svc/temporal_pddl/improvement/earliest_finish.hpp"

#include <algorithm>
#include <functional>

namespace roci::planner::temporal_pddl {

EarliestFinish::EarliestFinish(const Task& task)
    : task_(task),
      relaxed_(task),
      facts_(relaxed_.propositions()),
      at_first_(relaxed_.operators()),
      needed_(relaxed_.propositions(), false),
      in_plan_(relaxed_.operators(), false),
      times_(relaxed_.operators(), kNever),
      free_from_(task.layout.variables().size(), 0) {
  for (std::size_t i = 0; i < relaxed_.operators(); ++i)
    at_first_[SnapId(i)].open = static_cast<std::uint32_t>(relaxed_.needs(SnapId(i)).size());
}

Ticks EarliestFinish::measure(const Situation& situation) {
  plan_.clear();
  preferred_.clear();
  to_support_.clear();
  needed_.assign(needed_.size(), false);
  in_plan_.assign(in_plan_.size(), false);
  explore(situation);
  const Goal* goal = soonest_goal();
  if (!goal) return kNever;
  for (const FactId fact : goal->facts) need(relaxed_.proposition(fact));
  for (const ActionId action : situation.running) include(task_.actions[action].end);
  while (!to_support_.empty()) {
    const PropositionId supported = to_support_.back();
    to_support_.pop_back();
    include(facts_[supported].by);
  }
  find_preferred();
  return schedule();
}

void EarliestFinish::reach(PropositionId proposition, Ticks time, SnapId by) {
  if (facts_[proposition].time <= time) return;
  facts_[proposition] = {time, by};
  queue_.emplace_back(time, proposition);
  std::ranges::push_heap(queue_, std::greater{});
}

// The first time from `ready` on at which windows allow the step; kNever: none.
Ticks EarliestFinish::fit(SnapId op, Ticks ready) const {
  if (task_.windows[op].empty()) return ready;
  const TimeWindow* window = window_from(task_.windows[op], Duration(ready));
  return window ? std::max(ready, window->open.count()) : kNever;
}

void EarliestFinish::fire(SnapId op, const TimeFreedom& freedom) {
  Ticks time = operators_[op].ready;
  for (const VariableId variable : task_.writes[op]) time = std::max(time, freedom.to_change(variable));
  time = fit(op, time);
  if (time == kNever || time > limit_) return;
  times_[op] = time;
  for (const PropositionId added : relaxed_.adds(op)) reach(added, time, op);
}

// In order of time, until a goal is reached: what comes later serves nothing.
void EarliestFinish::explore(const Situation& situation) {
  const TimeFreedom& freedom = *situation.freedom;
  facts_.assign(facts_.size(), Fact{});
  times_.assign(times_.size(), kNever);
  operators_ = at_first_;
  queue_.clear();
  relaxed_.each_fact(task_, situation.state, [&](FactId fact) {
    reach(relaxed_.proposition(fact), freedom.to_read(task_.variable(fact)), SnapId());
  });
  for (std::size_t i = 0; i < situation.running.size(); ++i)
    reach(relaxed_.running(situation.running[i]), situation.started[i], SnapId());
  for (std::size_t i = situation.timed_done; i < task_.timed_steps.size(); ++i) {
    const TimedStep& timed = task_.timed_steps[i];
    times_[timed.snap] = timed.time.count();
    for (const PropositionId added : relaxed_.adds(timed.snap)) reach(added, timed.time.count(), timed.snap);
  }
  for (const SnapId op : relaxed_.free()) fire(op, freedom);
  for (std::size_t settled_at = 0; !queue_.empty();) {
    std::ranges::pop_heap(queue_, std::greater{});
    const auto [time, proposition] = queue_.back();
    queue_.pop_back();
    if (time > facts_[proposition].time) continue;
    if (situation.running.empty() && ++settled_at % 64 == 0 &&
        std::ranges::any_of(task_.goals, [&](const Goal& goal) { return settled(goal, time); }))
      return;
    for (const SnapId op : relaxed_.needed_by(proposition)) {
      const Snap& snap = task_.snaps[op];
      const bool follows_start = snap.kind == SnapKind::end && proposition == relaxed_.running(snap.action);
      const Ticks least = follows_start ? task_.actions[snap.action].min_duration.count() : 0;
      operators_[op].ready = std::max(operators_[op].ready, time + least);
      if (--operators_[op].open == 0) fire(op, freedom);
    }
  }
}

bool EarliestFinish::settled(const Goal& goal, Ticks now) const {
  return std::ranges::all_of(goal.facts,
                             [&](FactId fact) { return facts_[relaxed_.proposition(fact)].time <= now; });
}

const Goal* EarliestFinish::soonest_goal() const {
  const Goal* best = nullptr;
  Ticks best_time = kNever;
  for (const Goal& goal : task_.goals) {
    Ticks time = 0;
    for (const FactId fact : goal.facts) time = std::max(time, facts_[relaxed_.proposition(fact)].time);
    if (time >= best_time) continue;
    best = &goal;
    best_time = time;
  }
  return best;
}

void EarliestFinish::need(PropositionId proposition) {
  if (needed_[proposition] || facts_[proposition].by.is_none()) return;
  needed_[proposition] = true;
  to_support_.push_back(proposition);
}

void EarliestFinish::include(SnapId op) {
  if (in_plan_[op] || times_[op] == kNever) return;
  in_plan_[op] = true;
  plan_.push_back(op);
  for (const PropositionId needed : relaxed_.needs(op)) need(needed);
  if (task_.snaps[op].kind == SnapKind::start) include(task_.actions[task_.snaps[op].action].end);
}

void EarliestFinish::find_preferred() {
  for (const SnapId op : plan_) {
    const SnapKind kind = task_.snaps[op].kind;
    if (kind == SnapKind::derivation || kind == SnapKind::timed_literal) continue;
    if (std::ranges::all_of(relaxed_.needs(op),
                            [&](PropositionId needed) { return facts_[needed].by.is_none(); }))
      preferred_.push_back(op);
  }
}

Ticks EarliestFinish::schedule() {
  for (const std::size_t variable : occupied_) free_from_[variable] = 0;
  occupied_.clear();
  std::ranges::stable_sort(plan_, {}, [&](SnapId op) { return times_[op]; });
  Ticks finish = 0;
  for (const SnapId op : plan_) finish = std::max(finish, place(op));
  std::ranges::stable_sort(plan_, {}, [&](SnapId op) { return times_[op]; });
  return finish;
}

// When its action ends.
Ticks EarliestFinish::place(SnapId op) {
  const Snap& snap = task_.snaps[op];
  if (snap.kind == SnapKind::timed_literal || snap.kind == SnapKind::derivation) return 0;
  Ticks& time = times_[op];
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
  const Ticks end = time + action.min_duration.count();
  each_variable([&](std::size_t variable) {
    free_from_[variable] = end;
    occupied_.push_back(variable);
  });
  if (!action.instantaneous() && times_[action.end] != kNever)
    times_[action.end] = std::max(times_[action.end], end);
  return end;
}

}  // namespace roci::planner::temporal_pddl
