#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"

#include <algorithm>
#include <functional>

namespace roci::planner::temporal_pddl::heuristics {

using task::FactId, task::IdVector, task::Snap, task::SnapId, task::SnapKind, task::Task, task::TimeWindow,
    task::TimedStep;
using temporal::Duration, temporal::no_bound;

EarliestTimes::EarliestTimes(const Task& task, const RelaxedTask& relaxed)
    : task_(task),
      relaxed_(relaxed),
      matters_(task.has_absolute_times()),
      times_(relaxed.propositions(), no_bound),
      supporters_(relaxed.propositions()),
      initially_open_(relaxed.operators(), 0),
      ready_(relaxed.operators(), Duration{0}),
      op_times_(relaxed.operators(), no_bound) {
  for (std::size_t i = 0; i < relaxed.operators(); ++i)
    initially_open_[SnapId(i)] = static_cast<std::uint32_t>(relaxed.needs(SnapId(i)).size());
}

void EarliestTimes::measure(const EvaluationContext& context) {
  std::ranges::fill(times_, no_bound);
  std::ranges::fill(op_times_, no_bound);
  std::ranges::fill(ready_, Duration{0});
  open_ = initially_open_;
  queue_.clear();
  const auto add_fact = [&](FactId fact) {
    const auto* release_times = context.release_times;
    reach(relaxed_.proposition(fact),
          release_times ? release_times->to_read(task_.variable(fact)) : Duration{0}, SnapId());
  };
  relaxed_.each_fact(task_, context.state, add_fact);
  for (std::size_t i = 0; i < context.running.size(); ++i) {
    const bool known = i < context.started.size();
    reach(relaxed_.running(context.running[i]), known ? context.started[i] : Duration{0}, SnapId());
  }
  for (std::size_t i = context.timed_done; i < task_.timed_steps.size(); ++i) {
    const TimedStep& timed = task_.timed_steps[i];
    op_times_[timed.snap] = timed.time;
    for (const PropositionId added : relaxed_.adds(timed.snap)) reach(added, timed.time, timed.snap);
  }
  for (const SnapId op : relaxed_.free()) fire(op, context);
  while (!queue_.empty()) {
    std::ranges::pop_heap(queue_, std::greater{});
    const auto [time, proposition] = queue_.back();
    queue_.pop_back();
    if (time > times_[proposition]) continue;
    for (const SnapId op : relaxed_.needed_by(proposition)) {
      const Snap& snap = task_.snaps[op];
      const bool follows_start = snap.kind == SnapKind::end && proposition == relaxed_.running(snap.action);
      const Duration least = follows_start ? task_.actions[snap.action].min_duration : Duration{0};
      ready_[op] = std::max(ready_[op], time + least);
      if (--open_[op] == 0) fire(op, context);
    }
  }
}

void EarliestTimes::reach(PropositionId proposition, Duration time, SnapId by) {
  if (times_[proposition] <= time) return;
  times_[proposition] = time;
  supporters_[proposition] = by;
  queue_.emplace_back(time, proposition);
  std::ranges::push_heap(queue_, std::greater{});
}

void EarliestTimes::fire(SnapId op, const EvaluationContext& context) {
  const Duration free = context.release_times ? context.release_times->earliest(op) : Duration{0};
  const Duration time = fit(op, std::max(ready_[op], free));
  if (time == no_bound) return;
  op_times_[op] = time;
  for (const PropositionId added : relaxed_.adds(op)) reach(added, time, op);
}

Duration EarliestTimes::fit(SnapId op, Duration ready) const {
  const Snap& snap = task_.snaps[op];
  const auto first = [](std::span<const TimeWindow> windows, Duration from, Duration length) {
    if (windows.empty()) return from;
    for (const TimeWindow& window : windows) {
      const Duration time = std::max(from, window.open);
      if (window.close == no_bound || time + length <= window.close) return time;
    }
    return no_bound;
  };
  const Duration own = first(task_.windows[op], ready, Duration{0});
  const bool starts = snap.kind == SnapKind::start;
  if (own == no_bound || (!starts && snap.kind != SnapKind::end)) return own;
  const Duration to_come = starts ? task_.actions[snap.action].min_duration : Duration{0};
  return first(task_.span_windows[snap.action], own, to_come);
}

std::string EarliestTimes::lateness_reason(PropositionId proposition) const {
  std::vector<PropositionId> to_ask{proposition};
  IdVector<PropositionId, bool> asked(times_.size(), false);
  asked[proposition] = true;
  while (!to_ask.empty()) {
    const PropositionId wanted = to_ask.back();
    to_ask.pop_back();
    for (std::size_t i = 0; i < op_times_.size(); ++i) {
      const SnapId op(i);
      if (std::ranges::count(relaxed_.adds(op), wanted) == 0) continue;
      if (open_[op] == 0 && op_times_[op] == no_bound) return lateness_of(op);
      for (const PropositionId need : relaxed_.needs(op)) {
        if (times_[need] == no_bound && !asked[need]) to_ask.push_back(need);
        asked[need] = true;
      }
    }
  }
  return {};
}

std::string EarliestTimes::lateness_of(SnapId op) const {
  const Snap& snap = task_.snaps[op];
  if (snap.kind == SnapKind::timed_literal) return {};
  const bool own = !task_.windows[op].empty();
  const auto windows = own ? task_.windows[op] : task_.span_windows[snap.action];
  const bool starts = snap.kind == SnapKind::start;
  const Duration length = starts && !own ? task_.actions[snap.action].min_duration : Duration{0};
  const Duration last = windows.back().close - length;
  const Duration ready = ready_[op];
  if (ready <= last) return name(task_, snap.action) + " is longer than each of its windows";
  const auto seconds = [](Duration time) {
    std::string text = std::to_string(temporal::to_seconds(time));
    return text.substr(0, text.size() - 3) + " s";
  };
  return name(task_, snap.action) + (starts ? " can start no sooner than " : " can end no sooner than ") +
         seconds(ready) + ", but must by " + seconds(last) + ": " + seconds(ready - last) + " too late";
}

}  // namespace roci::planner::temporal_pddl::heuristics
