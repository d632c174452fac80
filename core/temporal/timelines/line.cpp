#include "core/temporal/timelines/line.hpp"

#include <algorithm>
#include <tuple>

namespace roci::temporal::timelines {
namespace {

auto key(const Event& event) {
  return std::tuple(event.time, event.turn, event.kind, event.task, event.order);
}
bool earlier(const Event& a, const Event& b) { return key(a) < key(b); }

/// Carries a value from event to event.
struct Walk {
  Micros time;
  Exact value;
  Exact rate;
  void run_to(Micros to) {
    value += rate * (to - time);
    time = to;
  }
  void take(const Event& event) {
    if (event.kind == ImpactKind::assign) value = event.amount;
    if (event.kind == ImpactKind::delta) value += event.amount;
    if (event.kind == ImpactKind::rate) rate += event.amount;
  }
};

Turn last_turn_before(Side side) { return side == Side::between ? Turn::ends : Turn::observed; }

/// Fills a knot from the events at its instant, and returns the first event behind.
std::size_t fill(Knot& knot, std::span<const Event> events, std::size_t next, Walk& walk) {
  knot.before = knot.ends_assigned = walk.value;
  const auto take_turn = [&](Turn turn, Exact& assigned, Reset& reset) {
    assigned = walk.value;
    for (; next < events.size() && events[next].time == knot.time && events[next].turn == turn; ++next) {
      walk.take(events[next]);
      if (events[next].kind != ImpactKind::assign) continue;
      assigned = walk.value;
      reset = Reset{knot.time, turn};
    }
  };
  knot.reset_between = knot.reset_before;
  take_turn(Turn::ends, knot.ends_assigned, knot.reset_between);
  knot.between = walk.value;
  knot.reset_after = knot.reset_between;
  take_turn(Turn::starts, knot.starts_assigned, knot.reset_after);
  Exact observed = 0;
  take_turn(Turn::observed, observed, knot.reset_after);
  knot.after = walk.value;
  knot.rate = walk.rate;
  return next;
}

}  // namespace

void Line::add(const Event& event) {
  events_.insert(std::ranges::upper_bound(events_, event, earlier), event);
}

void Line::erase(const Event& event) {
  const auto found = std::ranges::lower_bound(events_, event, earlier);
  if (found != events_.end() && key(*found) == key(event)) events_.erase(found);
}

void Line::add(const Ask& ask) { asks_.push_back(ask); }

void Line::erase(TaskId task, std::uint32_t constraint) {
  const auto found = std::ranges::find_if(
      asks_, [&](const Ask& ask) { return ask.task == task && ask.constraint == constraint; });
  if (found == asks_.end()) return;
  *found = asks_.back();
  asks_.pop_back();
}

void Line::amend(Exact value, Exact rate) {
  base_ += value;
  base_rate_ += rate;
}

void Line::observe(Micros time, Exact value) {
  const Event event{time, Turn::observed, ImpactKind::assign, 0, 0, value};
  erase(event);
  add(event);
}

void Line::fold(Micros now) {
  Walk walk{past_, base_, base_rate_};
  std::size_t folded = 0;
  for (; folded < events_.size() && events_[folded].time < now; ++folded) {
    walk.run_to(events_[folded].time);
    walk.take(events_[folded]);
  }
  walk.run_to(now);
  events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(folded));
  base_ = walk.value;
  base_rate_ = walk.rate;
  past_ = now;
  const Position edge{now, Side::before};
  std::erase_if(asks_, [&](const Ask& ask) { return ask.to < edge; });
  for (Ask& ask : asks_) ask.from = std::max(ask.from, edge);
}

Exact Line::value(Position at) const {
  Walk walk{past_, base_, base_rate_};
  if (at.time < past_) return walk.value;
  for (const Event& event : events_) {
    if (event.time > at.time || (event.time == at.time && at.side == Side::before) ||
        (event.time == at.time && event.turn > last_turn_before(at.side)))
      break;
    walk.run_to(event.time);
    walk.take(event);
  }
  walk.run_to(at.time);
  return walk.value;
}

std::vector<Knot> Line::knots() const {
  std::vector<Micros> times{past_, end_};
  for (const Event& event : events_) times.push_back(event.time);
  for (const Ask& ask : asks_) {
    times.push_back(ask.from.time);
    times.push_back(ask.to.time);
  }
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  std::vector<Knot> knots(times.size());
  Walk walk{past_, base_, base_rate_};
  std::size_t next = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    walk.run_to(times[i]);
    knots[i].time = times[i];
    if (i > 0) knots[i].reset_before = knots[i - 1].reset_after;
    next = fill(knots[i], events_, next, walk);
  }
  return knots;
}

}  // namespace roci::temporal::timelines
