#include "core/temporal/timelines/start_search.hpp"

#include <algorithm>
#include <array>

namespace roci::temporal::timelines {
namespace {

constexpr std::array kSides{Side::before, Side::between, Side::after};

/// Returns the first time at which what acts in that turn is not overridden by the reset.
Micros first_after(const Reset& reset, Turn turn) { return reset.time + (reset.turn > turn ? 1 : 0); }

Stretch common(Stretch a, Stretch b) { return {std::max(a.first, b.first), std::min(a.last, b.last)}; }

}  // namespace

void StartSearch::enter(std::size_t first, std::size_t last) {
  if (first == last) {
    knots_ = line_.knots(first);
  } else {
    line_.knots(first, last, joined_);
    knots_ = joined_;
  }
  count_ = knots_.size() - (last + 1 < line_.blocks() ? 1 : 0);
}

std::size_t StartSearch::knot_not_before(Micros time) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(knots_, time, {}, &Knot::time) - knots_.begin());
}

/// Returns the value without the task, at a knot the one that is named.
Exact StartSearch::base_at(Micros time, Exact Knot::*at_knot) const {
  const std::size_t knot = knot_not_before(time);
  if (knot < knots_.size() && knots_[knot].time == time) return knots_[knot].*at_knot;
  return base_inside(knot - 1, time);
}

/// Returns the value at the point with the task placed at `start`.
Exact StartSearch::value_with(const Point& point, Micros start) const {
  const auto acted = [&](Micros at, Side first_side) {
    return at < point.time || (at == point.time && point.side >= first_side);
  };
  if (!acted(start, Side::after)) return point.base;
  const Effect::Step& first = effect_.start;
  const Effect::Step& second = effect_.end;
  const Micros end = start + effect_.duration;
  const bool ended = effect_.duration > 0 && acted(end, Side::between);
  const bool start_counts = start >= first_after(point.reset, Turn::starts);
  const bool end_counts = ended && end >= first_after(point.reset, Turn::ends);
  // An assigned state is what it is, whatever it replaces.
  const auto replaced = [&](Micros time, Exact Knot::*at_knot) {
    return line_.range().states != 0 ? point.base : base_at(time, at_knot);
  };
  Exact value = point.base;
  if (end_counts && second.assign)
    return value - replaced(end, &Knot::ends_assigned) + *second.assign + second.delta +
           (first.rate + second.rate) * (point.time - end);
  if (start_counts) {
    if (first.assign) value += *first.assign - replaced(start, &Knot::starts_assigned);
    value += first.delta + first.rate * (point.time - start);
  } else {
    value += first.rate * (point.time - point.reset.time);
  }
  if (end_counts) value += second.delta + second.rate * (point.time - end);
  if (ended && !end_counts) value += second.rate * (point.time - point.reset.time);
  return value;
}

/// Cuts where the task's start or end comes to count, since it no longer lies before the reset.
void StartSearch::cut_at_reset(const Reset& reset) {
  cuts_.push_back(first_after(reset, Turn::starts));
  if (effect_.duration > 0) cuts_.push_back(first_after(reset, Turn::ends) - effect_.duration);
}

/// Cuts where the value that an assignment replaces changes its form.
void StartSearch::cut_at_knots(Stretch starts) {
  if (line_.range().states != 0) return;
  const auto cut = [&](Micros shift) {
    for (std::size_t k = knot_not_before(starts.first + shift);
         k < knots_.size() && knots_[k].time <= starts.last + shift; ++k) {
      cuts_.push_back(knots_[k].time - shift);
      cuts_.push_back(knots_[k].time - shift + 1);
    }
  };
  if (effect_.start.assign) cut(0);
  if (effect_.end.assign) cut(effect_.duration);
}

/// Finds the bad ones of the starts; between two cuts the value is a straight function of the start.
template <class ValueAt>
void StartSearch::in_pieces(const Bounds& bounds, Stretch starts, ValueAt value_at) {
  std::ranges::sort(cuts_);
  cuts_.push_back(starts.last + 1);
  Micros first = starts.first;
  for (const Micros cut : cuts_) {
    const Micros last = std::min(cut - 1, starts.last);
    if (last < first) continue;
    const Exact value = value_at(first);
    const Exact rise = last > first ? value_at(last) - value : 0;
    const Exact rate = rise == 0 ? 0 : rise / (last - first);
    const Outside out = outside(bounds, value, rate, {first, last});
    bad_.insert(bad_.end(), out.parts.begin(), out.parts.begin() + static_cast<std::ptrdiff_t>(out.count));
    first = last + 1;
  }
  cuts_.clear();
}

void StartSearch::look_at(const Bounds& bounds, const Point& point, Stretch starts) {
  starts = common(starts, window_);
  if (starts.last < starts.first) return;
  cuts_.push_back(point.time + (point.side == Side::after ? 1 : 0));
  if (effect_.duration > 0)
    cuts_.push_back(point.time - effect_.duration + (point.side == Side::before ? 0 : 1));
  cut_at_reset(point.reset);
  cut_at_knots(starts);
  in_pieces(bounds, starts, [&](Micros start) { return value_with(point, start); });
}

/// Looks at the value right after the start, where that lies between a knot and the next.
void StartSearch::look_at_start(const Bounds& bounds, std::size_t knot, Stretch times) {
  const Stretch starts = common(times, window_);
  if (starts.last < starts.first) return;
  in_pieces(bounds, starts, [&](Micros start) {
    return value_with({start, Side::after, base_inside(knot, start), knots_[knot].reset_after}, start);
  });
}

/// Looks at the value right before or after the end, where that lies between a knot and the next.
void StartSearch::look_at_end(const Bounds& bounds, std::size_t knot, Stretch times, Side side) {
  const Micros duration = effect_.duration;
  const Stretch starts = common({times.first - duration, times.last - duration}, window_);
  if (starts.last < starts.first) return;
  cut_at_reset(knots_[knot].reset_after);
  cut_at_knots(starts);
  in_pieces(bounds, starts, [&](Micros start) {
    const Micros end = start + duration;
    return value_with({end, side, base_inside(knot, end), knots_[knot].reset_after}, start);
  });
}

/// Keeps bounds that hold without the task over `times`, between a knot and the next. The value is greatest and least
/// at the ends of that stretch, at the start and at the end.
void StartSearch::keep_inside(const Bounds& bounds, std::size_t knot, Stretch times) {
  look_at_start(bounds, knot, times);
  if (effect_.duration == 0) return;
  look_at_end(bounds, knot, times, Side::before);
  look_at_end(bounds, knot, times, Side::after);
}

void StartSearch::keep_for_others(const Bounds& bounds, Position from, Position to) {
  for (std::size_t k = knot_not_before(from.time); k < count_ && knots_[k].time <= to.time; ++k) {
    for (const Side side : kSides) {
      const Position here{knots_[k].time, side};
      if (here < from || here > to || here.time < window_.first || !bounds.admits(knots_[k].at(side)))
        continue;
      look_at(bounds, at_knot(k, side), window_);
    }
    if (knots_[k].time >= to.time || interior(k).last < interior(k).first || interior(k).last < window_.first)
      continue;
    const Stretch all = interior(k);
    const Outside out = outside(bounds, base_inside(k, all.first), knots_[k].rate, all);
    Micros first = all.first;
    for (std::size_t i = 0; i <= out.count; ++i) {
      const Stretch fine{first, i < out.count ? out.parts[i].first - 1 : all.last};
      if (i < out.count) first = out.parts[i].last + 1;
      if (fine.last < fine.first) continue;
      keep_inside(bounds, k, fine);
      const bool by_knots =
          out.count == 0 && bounds.admits(knots_[k].after) && bounds.admits(knots_[k + 1].before);
      if (by_knots) continue;  // they were looked at, and the value runs straight between them
      for (const Micros time : {fine.first, fine.last})
        look_at(bounds, {time, Side::after, base_inside(k, time), knots_[k].reset_after}, window_);
    }
  }
}

void StartSearch::keep_pre(const Bounds& bounds) {
  for (std::size_t k = 0; k < count_ && knots_[k].time <= window_.last; ++k) {
    const Micros time = knots_[k].time;
    if (time >= window_.first && !bounds.admits(knots_[k].between)) bad_.push_back({time, time});
    if (k + 1 == knots_.size()) break;
    const Stretch starts = common(interior(k), window_);
    if (starts.last < starts.first) continue;
    const Outside out = outside(bounds, base_inside(k, starts.first), knots_[k].rate, starts);
    bad_.insert(bad_.end(), out.parts.begin(), out.parts.begin() + static_cast<std::ptrdiff_t>(out.count));
  }
}

void StartSearch::keep_maintenance(const Bounds& bounds) {
  const Micros duration = effect_.duration;
  if (duration == 0) return;
  for (std::size_t k = 0; k < count_; ++k) {
    const Micros time = knots_[k].time;
    look_at(bounds, at_knot(k, Side::before), {time - duration, time - 1});
    look_at(bounds, at_knot(k, Side::between), {time - duration + 1, time - 1});
    look_at(bounds, at_knot(k, Side::after), {time - duration + 1, time});
    if (k + 1 == knots_.size() || interior(k).last < interior(k).first) continue;
    look_at_start(bounds, k, interior(k));
    look_at_end(bounds, k, interior(k), Side::before);
  }
}

void StartSearch::keep_post(const Bounds& bounds) {
  const Micros duration = effect_.duration;
  for (std::size_t k = 0; k < count_; ++k) {
    const Micros start = knots_[k].time - duration;
    look_at(bounds, at_knot(k, duration > 0 ? Side::between : Side::after), {start, start});
    if (k + 1 == knots_.size() || interior(k).last < interior(k).first) continue;
    if (duration > 0) {
      look_at_end(bounds, k, interior(k), Side::between);
    } else {
      look_at_start(bounds, k, interior(k));
    }
  }
}

void StartSearch::keep(const Constraint& constraint, const Bounds& bounds) {
  if (constraint.phase == Phase::pre) keep_pre(bounds);
  if (constraint.phase == Phase::maintenance) keep_maintenance(bounds);
  if (constraint.phase == Phase::post) keep_post(bounds);
}

}  // namespace roci::temporal::timelines
