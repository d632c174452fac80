#include "core/temporal/timelines/block.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace roci::temporal::timelines {
namespace {

auto key(const Event& event) {
  return std::tuple(event.time, event.turn, event.kind, event.task, event.order);
}
bool earlier(const Event& a, const Event& b) { return key(a) < key(b); }

/// Carries a course from event to event.
struct Walk {
  Micros time;
  Course course;
  void run_to(Micros to) {
    course.value += course.rate * (to - time);
    time = to;
  }
  void take(const Event& event) {
    if (event.kind == ImpactKind::delta) course.value += event.amount;
    if (event.kind == ImpactKind::rate) course.rate += event.amount;
    if (event.kind != ImpactKind::assign) return;
    course.value = event.amount;
    course.reset = {event.time, event.turn};
  }
};

/// Fills a knot from the events at its instant, and returns the first event behind.
std::size_t fill(Knot& knot, const std::vector<Event>& events, std::size_t next, Walk& walk) {
  const auto take_turn = [&](Turn turn, Exact& assigned) {
    assigned = walk.course.value;
    for (; next < events.size() && events[next].time == knot.time && events[next].turn == turn; ++next) {
      walk.take(events[next]);
      if (events[next].kind == ImpactKind::assign) assigned = walk.course.value;
    }
  };
  knot.before = walk.course.value;
  knot.reset_before = walk.course.reset;
  take_turn(Turn::ends, knot.ends_assigned);
  knot.between = walk.course.value;
  knot.reset_between = walk.course.reset;
  take_turn(Turn::starts, knot.starts_assigned);
  Exact observed = 0;
  take_turn(Turn::observed, observed);
  knot.after = walk.course.value;
  knot.reset_after = walk.course.reset;
  knot.rate = walk.course.rate;
  return next;
}

}  // namespace

bool Block::resets() const { return sum().resets; }

void Block::changed() {
  sum_.known = false;
  summarized_ = false;
}

void Block::add(const Event& event) {
  events_.insert(std::ranges::upper_bound(events_, event, earlier), event);
  changed();
}

bool Block::erase(const Event& event) {
  const auto found = std::ranges::lower_bound(events_, event, earlier);
  if (found == events_.end() || key(*found) != key(event)) return false;
  events_.erase(found);
  changed();
  return true;
}

void Block::add(const Ask& ask) {
  asks_.push_back(ask);
  if (ask.from.time >= first_) ++own_asks_;
  summarized_ = false;
}

void Block::erase(const Ask& ask) {
  const auto found = std::ranges::find_if(
      asks_, [&](const Ask& it) { return it.task == ask.task && it.constraint == ask.constraint; });
  if (found == asks_.end()) return;
  if (found->from.time >= first_) --own_asks_;
  *found = asks_.back();
  asks_.pop_back();
  summarized_ = false;
}

std::optional<Block> Block::split() {
  if (events_.size() + own_asks_ <= most_) return std::nullopt;
  std::vector<Micros> times;
  for (const Event& event : events_) times.push_back(event.time);
  for (const Ask& ask : asks_)
    if (ask.from.time >= first_) times.push_back(ask.from.time);
  std::ranges::sort(times);
  const auto middle = std::ranges::upper_bound(times, std::max(first_, times[times.size() / 2] - 1));
  if (middle == times.end()) {
    most_ *= 2;  // all happens at one instant
    return std::nullopt;
  }
  Block later(*middle, most_);
  const auto cut = std::ranges::lower_bound(events_, later.first_, {}, &Event::time);
  later.events_.assign(cut, events_.end());
  events_.erase(cut, events_.end());
  for (const Ask& ask : asks_)
    if (ask.to.time >= later.first_) later.add(ask);
  std::erase_if(asks_, [&](const Ask& ask) { return ask.from.time >= later.first_; });
  own_asks_ = static_cast<std::size_t>(
      std::ranges::count_if(asks_, [&](const Ask& ask) { return ask.from.time >= first_; }));
  changed();
  return later;
}

const Block::Sum& Block::sum() const {
  if (sum_.known) return sum_;
  sum_ = Sum{};
  Micros from = first_;
  for (const Event& event : events_) {
    switch (event.kind) {
      case ImpactKind::assign:
        sum_.resets = true;
        sum_.reset = {event.time, event.turn};
        sum_.assigned = event.amount;
        sum_.rate_before += sum_.rate;
        sum_.delta = sum_.rate = sum_.moment = 0;
        from = event.time;
        break;
      case ImpactKind::delta:
        sum_.delta += event.amount;
        break;
      case ImpactKind::rate:
        sum_.rate += event.amount;
        sum_.moment += event.amount * (event.time - from);
        break;
    }
  }
  sum_.known = true;
  return sum_;
}

Course Block::run(const Course& at_first, Micros end) const {
  const Sum& sum = this->sum();
  const Micros length = end - (sum.resets ? sum.reset.time : first_);
  Course course = at_first;
  if (sum.resets) {
    course.value = sum.assigned;
    course.rate += sum.rate_before;
    course.reset = sum.reset;
  }
  course.value += (course.rate + sum.rate) * length + sum.delta - sum.moment;
  course.rate += sum.rate;
  return course;
}

Course Block::at(const Course& at_first, Position place) const {
  Walk walk{first_, at_first};
  const auto acted = [&](const Event& event) {
    if (event.time != place.time) return event.time < place.time;
    return place.side == Side::after || (place.side == Side::between && event.turn == Turn::ends);
  };
  for (const Event& event : events_) {
    if (!acted(event)) break;
    walk.run_to(event.time);
    walk.take(event);
  }
  walk.run_to(place.time);
  return walk.course;
}

void Block::knots(const Course& at_first, Micros closing, std::vector<Knot>& knots) const {
  const std::size_t begin = knots.size();
  const auto add = [&](Micros time) { knots.emplace_back().time = time; };
  add(first_);
  for (const Event& event : events_)
    if (event.time != knots.back().time) add(event.time);
  if (!asks_.empty()) {
    for (const Ask& ask : asks_) {
      if (ask.from.time > first_) add(ask.from.time);
      if (ask.to.time > first_ && ask.to.time < closing) add(ask.to.time);
    }
    std::ranges::sort(knots.begin() + static_cast<std::ptrdiff_t>(begin), knots.end(), {}, &Knot::time);
    const auto same =
        std::ranges::unique(knots.begin() + static_cast<std::ptrdiff_t>(begin), knots.end(), {}, &Knot::time);
    knots.erase(same.begin(), same.end());
  }
  if (knots.back().time != closing) add(closing);
  Walk walk{first_, at_first};
  std::size_t next = 0;
  for (std::size_t i = begin; i < knots.size(); ++i) {
    walk.run_to(knots[i].time);
    next = fill(knots[i], events_, next, walk);
  }
}

void Block::summarize(const Bounds& range, const Course& at_first, Micros closing,
                      std::span<const Knot> knots) const {
  summary_ = Summary{};
  const auto see = [&](Exact value) {
    summary_.lowest = std::min(summary_.lowest, value);
    summary_.highest = std::max(summary_.highest, value);
    if (range.states != 0) summary_.states |= std::uint64_t{1} << (state_of(value) & 63);
  };
  const auto keep = [&](const Bounds& bounds, Exact value) {
    summary_.fine = summary_.fine && bounds.admits(value);
    summary_.room_below = std::min(summary_.room_below, value - bounds.lowest);
    summary_.room_above = std::min(summary_.room_above, bounds.highest - value);
  };
  constexpr std::array kSides{Side::before, Side::between, Side::after};
  for (const Knot& knot : knots)
    for (const Side side : kSides) {
      see(knot.at(side));
      keep(range, knot.at(side));
    }
  for (const Ask& ask : asks_) {
    auto knot = std::ranges::lower_bound(knots, ask.from.time, {}, &Knot::time);
    for (; knot != knots.end() && knot->time <= ask.to.time; ++knot)
      for (const Side side : kSides) {
        const Position here{knot->time, side};
        if (here >= ask.from && here <= ask.to) keep(ask.bounds, knot->at(side));
      }
  }
  summarized_ = true;
  summarized_at_ = at_first;
  summarized_to_ = closing;
}

bool Block::summarized(const Bounds& range, const Course& at_first, Micros closing) const {
  if (!summarized_ || at_first.rate != summarized_at_.rate || closing != summarized_to_) return false;
  const Exact shift = at_first.value - summarized_at_.value;
  if (shift == 0) return true;
  if (range.states != 0 || resets() || !summary_.fine) return false;
  if (summary_.room_below + shift < 0 || summary_.room_above - shift < 0) return false;
  summary_.room_below += shift;
  summary_.room_above -= shift;
  summary_.lowest += shift;
  summary_.highest += shift;
  summarized_at_.value = at_first.value;
  return true;
}

}  // namespace roci::temporal::timelines
