#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"

#include <algorithm>
#include <functional>

namespace roci::planner::temporal_pddl {

EarliestTimes::EarliestTimes(const Task& task, const RelaxedTask& relaxed)
    : task_(task),
      relaxed_(relaxed),
      matters_(task.has_absolute_times()),
      times_(relaxed.propositions(), kNever),
      supporters_(relaxed.propositions()),
      initially_open_(relaxed.operators(), 0),
      ready_(relaxed.operators(), 0),
      op_times_(relaxed.operators(), kNever) {
  for (std::size_t i = 0; i < relaxed.operators(); ++i)
    initially_open_[SnapId(i)] = static_cast<std::uint32_t>(relaxed.needs(SnapId(i)).size());
}

void EarliestTimes::measure(const Situation& situation) {
  std::ranges::fill(times_, kNever);
  std::ranges::fill(op_times_, kNever);
  std::ranges::fill(ready_, 0);
  open_ = initially_open_;
  queue_.clear();
  const auto add_fact = [&](FactId fact) {
    const auto* freedom = situation.freedom;
    reach(relaxed_.proposition(fact), freedom ? freedom->to_read(task_.variable(fact)) : 0, SnapId());
  };
  relaxed_.each_fact(task_, situation.state, add_fact);
  for (std::size_t i = 0; i < situation.running.size(); ++i) {
    const bool known = i < situation.started.size();
    reach(relaxed_.running(situation.running[i]), known ? situation.started[i] : 0, SnapId());
  }
  for (std::size_t i = situation.timed_done; i < task_.timed_steps.size(); ++i) {
    const TimedStep& timed = task_.timed_steps[i];
    op_times_[timed.snap] = timed.time.count();
    for (const PropositionId added : relaxed_.adds(timed.snap)) reach(added, timed.time.count(), timed.snap);
  }
  for (const SnapId op : relaxed_.free()) fire(op, situation);
  while (!queue_.empty()) {
    std::ranges::pop_heap(queue_, std::greater{});
    const auto [time, proposition] = queue_.back();
    queue_.pop_back();
    if (time > times_[proposition]) continue;
    for (const SnapId op : relaxed_.needed_by(proposition)) {
      const Snap& snap = task_.snaps[op];
      const bool follows_start = snap.kind == SnapKind::end && proposition == relaxed_.running(snap.action);
      const Ticks least = follows_start ? task_.actions[snap.action].min_duration.count() : 0;
      ready_[op] = std::max(ready_[op], time + least);
      if (--open_[op] == 0) fire(op, situation);
    }
  }
}

void EarliestTimes::reach(PropositionId proposition, Ticks time, SnapId by) {
  if (times_[proposition] <= time) return;
  times_[proposition] = time;
  supporters_[proposition] = by;
  queue_.emplace_back(time, proposition);
  std::ranges::push_heap(queue_, std::greater{});
}

void EarliestTimes::fire(SnapId op, const Situation& situation) {
  const Ticks free = situation.freedom ? situation.freedom->earliest(op) : 0;
  const Ticks time = fit(op, std::max(ready_[op], free));
  if (time == kNever) return;
  op_times_[op] = time;
  for (const PropositionId added : relaxed_.adds(op)) reach(added, time, op);
}

Ticks EarliestTimes::fit(SnapId op, Ticks ready) const {
  const Snap& snap = task_.snaps[op];
  const auto first = [](std::span<const TimeWindow> windows, Ticks from, Ticks length) {
    if (windows.empty()) return from;
    for (const TimeWindow& window : windows) {
      const Ticks time = std::max(from, window.open.count());
      if (window.close == kUnbounded || time + length <= window.close.count()) return time;
    }
    return kNever;
  };
  const Ticks own = first(task_.windows[op], ready, 0);
  const bool starts = snap.kind == SnapKind::start;
  if (own == kNever || (!starts && snap.kind != SnapKind::end)) return own;
  const Ticks to_come = starts ? task_.actions[snap.action].min_duration.count() : 0;
  return first(task_.span_windows[snap.action], own, to_come);
}

std::string EarliestTimes::why_never(PropositionId proposition) const {
  std::vector<PropositionId> to_ask{proposition};
  IdVector<PropositionId, bool> asked(times_.size(), false);
  asked[proposition] = true;
  while (!to_ask.empty()) {
    const PropositionId wanted = to_ask.back();
    to_ask.pop_back();
    for (std::size_t i = 0; i < op_times_.size(); ++i) {
      const SnapId op(i);
      if (std::ranges::count(relaxed_.adds(op), wanted) == 0) continue;
      if (open_[op] == 0 && op_times_[op] == kNever) return lateness(op);
      for (const PropositionId need : relaxed_.needs(op)) {
        if (times_[need] == kNever && !asked[need]) to_ask.push_back(need);
        asked[need] = true;
      }
    }
  }
  return {};
}

std::string EarliestTimes::lateness(SnapId op) const {
  const Snap& snap = task_.snaps[op];
  if (snap.kind == SnapKind::timed_literal) return {};
  const bool own = !task_.windows[op].empty();
  const auto windows = own ? task_.windows[op] : task_.span_windows[snap.action];
  const bool starts = snap.kind == SnapKind::start;
  const Ticks length = starts && !own ? task_.actions[snap.action].min_duration.count() : 0;
  const Ticks last = windows.back().close.count() - length;
  const Ticks ready = ready_[op];
  if (ready <= last) return name(task_, snap.action) + " is longer than each of its windows";
  const auto seconds = [](Ticks time) {
    std::string text = std::to_string(static_cast<double>(time) * 1e-6);
    return text.substr(0, text.size() - 3) + " s";
  };
  return name(task_, snap.action) + (starts ? " can start no sooner than " : " can end no sooner than ") +
         seconds(ready) + ", but must by " + seconds(last) + ": " + seconds(ready - last) + " too late";
}

}  // namespace roci::planner::temporal_pddl
