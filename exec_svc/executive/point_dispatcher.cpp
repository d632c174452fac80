#include "exec_svc/executive/point_dispatcher.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::executive {

using temporal::bounded;
using temporal::Duration;
using temporal::Time;
using temporal::TimePoint;

PointDispatcher::PointDispatcher(const temporal::FlexiblePlan& plan, bool latest_starts, bool only_committed)
    : latest_starts_(latest_starts),
      owners_(point_owners(plan)),
      constraints_(all_constraints(plan)),
      precedence_(precedence_of(constraints_, owners_)),
      windows_(plan.point_count, constraints_, plan.origin),
      points_(plan.point_count),
      ends_(plan.activities.size()) {
  points_[temporal::origin_point].happened = plan.origin;
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const temporal::PlanActivity& activity = plan.activities[i];
    const bool held = only_committed && activity.commit != temporal::CommitState::committed;
    points_[activity.start_point].may_be_late = held || activity.lateness == temporal::LatenessPolicy::push;
    points_[activity.start_point].holds = held ? 1 : 0;
    if (bounded(activity.preferred_start))
      points_[activity.start_point].preferred = temporal::plus(plan.origin, activity.preferred_start);
    ends_[i] = activity.end_point;
  }
  for (TimePoint p = 1; p < points_.size(); ++p) {
    points_[p].unbegun = points_[p].unreached =
        static_cast<std::uint32_t>(precedence_.predecessors[p].size());
    points_[p].pending = points_[p].unbegun + points_[p].holds;
  }
  for (TimePoint p = 1; p < points_.size(); ++p) {
    if (precedence_.predecessors[p].empty()) reach(p);
    if (near(p)) enter_times(p);
  }
}

std::optional<Time> PointDispatcher::happened_at(TimePoint point) const { return points_[point].happened; }

void PointDispatcher::hold(TimePoint point) {
  ++points_[point].holds;
  ++points_[point].pending;
  ready_.erase(point);
}

void PointDispatcher::release(TimePoint point) {
  --points_[point].holds;
  satisfied(point);
}

std::vector<TimePoint> PointDispatcher::advance(Time now) {
  std::vector<TimePoint> newly_due;
  while (const auto entry = first_earliest()) {
    const TimePoint point = entry->second;
    if (entry->first > now) break;
    earliest_.pop();
    points_[point].due = true;
    newly_due.push_back(point);
    if (points_[point].pending == 0) ready_.insert(point);
  }
  return newly_due;
}

bool PointDispatcher::try_happen(TimePoint point, Time now) {
  windows_.happen(point, now);
  std::vector<TimePoint> first;
  for (const auto& [other, before] : windows_.latest_changes())
    if (watched(other) && other != point && before >= now && windows_.window(other).upper < now)
      first.push_back(other);
  if (first.empty()) {
    note_changes();
    points_[point].happened = now;
    ready_.erase(point);
    pass(point);
    return true;
  }
  take_back(point);
  ready_.erase(point);
  for (const TimePoint other : first) {
    precedence_.successors[other].push_back(point);
    precedence_.predecessors[point].push_back(other);
    ++points_[point].pending;
  }
  return false;
}

/// Windows at the front stay known, since only known ones are reported when they move.
void PointDispatcher::take_back(TimePoint point) {
  std::vector<TimePoint> unsettled;
  const auto collect = [&] {
    for (const auto* changes : {&windows_.earliest_changes(), &windows_.latest_changes()})
      for (const auto& change : *changes) unsettled.push_back(change.point);
  };
  collect();
  windows_.undo_happen(point);
  collect();
  for (const TimePoint other : unsettled)
    if (near(other) || watched(other)) static_cast<void>(windows_.window(other));
}

void PointDispatcher::happen(TimePoint point, Time at) {
  windows_.happen(point, at);
  note_changes();
  points_[point].happened = at;
  ready_.erase(point);
  pass(point);
}

void PointDispatcher::drop(TimePoint point) {
  windows_.drop(point);
  points_[point].dropped = true;
  note_changes();
  ready_.erase(point);
  if (points_[point].pending == 0) pass(point);
}

void PointDispatcher::set_duration(std::size_t activity, Duration lower, Duration upper) {
  windows_.set_bounds(activity, lower, upper);
  note_changes();
}

std::optional<TimePoint> PointDispatcher::late_start(Time now) {
  const auto entry = first_latest();
  return entry && entry->first < now ? std::optional(entry->second) : std::nullopt;
}

Time PointDispatcher::next_time(Time now) {
  Time next = temporal::no_bound;
  if (const auto earliest = first_earliest(); earliest && earliest->first > now) next = earliest->first;
  if (const auto latest = first_latest(); latest && latest->first >= now)
    next = std::min(next, latest->first + Duration{1});
  return next;
}

/// Points behind the front need no watching yet, and cost nothing.
bool PointDispatcher::watched(TimePoint point) const { return open(point) && points_[point].unreached == 0; }

Time PointDispatcher::due_time(TimePoint point) const {
  const temporal::Window window = windows_.window(point);
  if (!waits(point)) return window.lower;
  const Time wish = std::min(points_[point].preferred, window.upper);
  return bounded(wish) ? std::max(window.lower, wish) : window.lower;
}

bool PointDispatcher::waits(TimePoint point) const {
  return owners_[point].role == PointRole::start && (latest_starts_ || bounded(points_[point].preferred));
}

void PointDispatcher::enter_times(TimePoint point) {
  if (near(point) && commanded(point)) {
    const Time due = due_time(point);
    if (bounded(due)) earliest_.enter(due, point);
  }
  if (points_[point].unreached > 0) return;
  // Ends are asked for, too, so that from now on their windows are known and reported when they move.
  const Time upper = windows_.window(point).upper;
  const bool may_be_late = owners_[point].role != PointRole::start || points_[point].may_be_late;
  if (!may_be_late && bounded(upper)) latest_.enter(upper, point);
}

void PointDispatcher::note_changes() {
  for (const auto& [point, before] : windows_.earliest_changes()) {
    if (!open(point) || windows_.happened(point) || !near(point)) continue;
    if (-before == windows_.window(point).lower) continue;
    points_[point].due = false;
    ready_.erase(point);
    enter_times(point);
  }
  for (const auto& [point, before] : windows_.latest_changes()) {
    if (!watched(point) || windows_.happened(point) || before == windows_.window(point).upper) continue;
    if (waits(point)) {
      points_[point].due = false;
      ready_.erase(point);
    }
    enter_times(point);
  }
}

void PointDispatcher::begin(TimePoint point) {
  if (std::exchange(points_[point].begun, true)) return;
  for (const TimePoint successor : precedence_.successors[point])
    if (points_[successor].unbegun > 0 && --points_[successor].unbegun == 0 && open(successor))
      enter_times(successor);
  reach(point);
}

/// Lets the search for late starts go on behind what has begun and behind what cannot be late itself.
void PointDispatcher::reach(TimePoint point) {
  std::vector<TimePoint> reached{point};
  while (!reached.empty()) {
    const TimePoint at = reached.back();
    reached.pop_back();
    PointState& state = points_[at];
    if (!state.begun && owners_[at].role == PointRole::start && !state.may_be_late) continue;
    if (std::exchange(state.reached_on, true)) continue;
    for (const TimePoint successor : precedence_.successors[at]) {
      if (points_[successor].unreached == 0 || --points_[successor].unreached > 0) continue;
      if (open(successor)) enter_times(successor);
      reached.push_back(successor);
    }
  }
}

void PointDispatcher::satisfied(TimePoint point) {
  PointState& state = points_[point];
  if (--state.pending > 0) return;
  if (state.dropped) {
    pass(point);
  } else if (state.due && !state.happened && commanded(point)) {
    ready_.insert(point);
  }
}

/// Tells the successors; dropped ones among them pass it on. It is a loop, since chains of dropped points may
/// be long.
void PointDispatcher::pass(TimePoint point) {
  std::vector<TimePoint> passing{point};
  while (!passing.empty()) {
    const TimePoint passed = passing.back();
    passing.pop_back();
    if (std::exchange(points_[passed].passed, true)) continue;
    begin(passed);
    if (owners_[passed].role == PointRole::start) begin(ends_[owners_[passed].activity]);
    for (const TimePoint successor : precedence_.successors[passed]) {
      if (!points_[successor].dropped) {
        satisfied(successor);
      } else if (--points_[successor].pending == 0) {
        passing.push_back(successor);
      }
    }
  }
}

std::optional<Agenda::Entry> PointDispatcher::first_earliest() {
  return earliest_.first(
      [&](Time at, TimePoint point) { return open(point) && !points_[point].due && due_time(point) == at; });
}

std::optional<Agenda::Entry> PointDispatcher::first_latest() {
  return latest_.first([&](Time at, TimePoint point) {
    return open(point) && !points_[point].may_be_late && windows_.window(point).upper == at;
  });
}

}  // namespace roci::exec::executive
