#include "core/temporal/timelines/placement.hpp"

#include <algorithm>

namespace roci::temporal::timelines {
namespace {

/// Is a place at which the value is looked at, with what is there without the task.
struct Point {
  Micros time = 0;
  Side side = Side::after;
  Exact base = 0;
  Reset reset{};
};

constexpr std::array kSides{Side::before, Side::between, Side::after};

/// Adds the step to another, as if both acted at one place.
void join(Effect::Step& step, const Effect::Step& other) {
  if (other.assign) step.assign = other.assign;
  step.delta += other.delta;
  step.rate += other.rate;
}

class Search {
 public:
  Search(const Line& line, const Effect& effect, Stretch window, std::vector<Stretch>& bad)
      : line_(line), effect_(effect), window_(window), bad_(bad), knots_(line.knots()) {}

  void keep_for_others(const Bounds& bounds, Position from, Position to);
  void keep(const Constraint& constraint, const Bounds& bounds);

 private:
  Exact value_with(const Point& point, Micros start) const;
  Exact base_at(Micros time, Exact Knot::*at_knot) const;
  std::size_t knot_not_before(Micros time) const;
  Stretch interior(std::size_t knot) const { return {knots_[knot].time + 1, knots_[knot + 1].time - 1}; }
  Exact base_inside(std::size_t knot, Micros time) const {
    return knots_[knot].after + knots_[knot].rate * (time - knots_[knot].time);
  }
  Point at_knot(std::size_t knot, Side side) const {
    return {knots_[knot].time, side, knots_[knot].at(side), knots_[knot].reset(side)};
  }

  void keep_inside(const Bounds& bounds, std::size_t knot, Stretch times);
  void look_at(const Bounds& bounds, const Point& point, Stretch starts);
  void look_at_start(const Bounds& bounds, std::size_t knot, Stretch times);
  void look_at_end(const Bounds& bounds, std::size_t knot, Stretch times, Side side);
  void keep_pre(const Bounds& bounds);
  void keep_maintenance(const Bounds& bounds);
  void keep_post(const Bounds& bounds);

  void cut_at_reset(const Reset& reset);
  void cut_at_knots(Stretch starts);
  template <class ValueAt>
  void in_pieces(const Bounds& bounds, Stretch starts, ValueAt value_at);

  const Line& line_;
  const Effect& effect_;
  Stretch window_;
  std::vector<Stretch>& bad_;
  std::vector<Knot> knots_;
  std::vector<Micros> cuts_;  ///< starts at which the value changes its form
};

/// Returns the first start whose effect at the start (or the end, for which it is the end) is not overridden by the reset.
Micros first_after(const Reset& reset, Turn turn) { return reset.time + (reset.turn > turn ? 1 : 0); }

Stretch common(Stretch a, Stretch b) { return {std::max(a.first, b.first), std::min(a.last, b.last)}; }

std::size_t Search::knot_not_before(Micros time) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(knots_, time, {}, &Knot::time) - knots_.begin());
}

/// Returns the value without the task, at a knot the one that is named.
Exact Search::base_at(Micros time, Exact Knot::*at_knot) const {
  const std::size_t knot = knot_not_before(time);
  if (knot < knots_.size() && knots_[knot].time == time) return knots_[knot].*at_knot;
  return base_inside(knot - 1, time);
}

/// Returns the value at the point with the task placed at `start`.
Exact Search::value_with(const Point& point, Micros start) const {
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
  Exact value = point.base;
  if (end_counts && second.assign)
    return value - base_at(end, &Knot::ends_assigned) + *second.assign + second.delta +
           (first.rate + second.rate) * (point.time - end);
  if (start_counts) {
    if (first.assign) value += *first.assign - base_at(start, &Knot::starts_assigned);
    value += first.delta + first.rate * (point.time - start);
  } else {
    value += first.rate * (point.time - point.reset.time);
  }
  if (end_counts) value += second.delta + second.rate * (point.time - end);
  if (ended && !end_counts) value += second.rate * (point.time - point.reset.time);
  return value;
}

/// Cuts where the task's start or end comes to count, since it no longer lies before the reset.
void Search::cut_at_reset(const Reset& reset) {
  cuts_.push_back(first_after(reset, Turn::starts));
  if (effect_.duration > 0) cuts_.push_back(first_after(reset, Turn::ends) - effect_.duration);
}

/// Cuts where the value that an assignment replaces changes its form.
void Search::cut_at_knots(Stretch starts) {
  if (line_.range().states != 0) return;  // an assigned state is what it is, whatever it replaces
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
void Search::in_pieces(const Bounds& bounds, Stretch starts, ValueAt value_at) {
  std::ranges::sort(cuts_);
  cuts_.push_back(starts.last + 1);
  Micros first = starts.first;
  for (const Micros cut : cuts_) {
    const Micros last = std::min(cut - 1, starts.last);
    if (last < first) continue;
    const Exact value = value_at(first);
    const Exact rate = last > first ? (value_at(last) - value) / (last - first) : 0;
    const Outside out = outside(bounds, value, rate, {first, last});
    bad_.insert(bad_.end(), out.parts.begin(), out.parts.begin() + static_cast<std::ptrdiff_t>(out.count));
    first = last + 1;
  }
  cuts_.clear();
}

void Search::look_at(const Bounds& bounds, const Point& point, Stretch starts) {
  starts = common(starts, window_);
  if (starts.last < starts.first) return;
  cuts_.push_back(point.time + (point.side == Side::after ? 1 : 0));
  if (effect_.duration > 0) cuts_.push_back(point.time - effect_.duration + (point.side == Side::before ? 0 : 1));
  cut_at_reset(point.reset);
  cut_at_knots(starts);
  in_pieces(bounds, starts, [&](Micros start) { return value_with(point, start); });
}

/// Looks at the value right after the start, where that lies between a knot and the next.
void Search::look_at_start(const Bounds& bounds, std::size_t knot, Stretch times) {
  const Stretch starts = common(times, window_);
  if (starts.last < starts.first) return;
  in_pieces(bounds, starts, [&](Micros start) {
    return value_with({start, Side::after, base_inside(knot, start), knots_[knot].reset_after}, start);
  });
}

/// Looks at the value right before or after the end, where that lies between a knot and the next.
void Search::look_at_end(const Bounds& bounds, std::size_t knot, Stretch times, Side side) {
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

/// Keeps bounds that hold without the task over `times`, between a knot and the next. The value is greatest and least at the ends of
/// that stretch, at the start and at the end.
void Search::keep_inside(const Bounds& bounds, std::size_t knot, Stretch times) {
  look_at_start(bounds, knot, times);
  if (effect_.duration == 0) return;
  look_at_end(bounds, knot, times, Side::before);
  look_at_end(bounds, knot, times, Side::after);
}

void Search::keep_for_others(const Bounds& bounds, Position from, Position to) {
  for (std::size_t k = knot_not_before(from.time); k < knots_.size() && knots_[k].time <= to.time; ++k) {
    for (const Side side : kSides) {
      const Position here{knots_[k].time, side};
      if (here < from || here > to || here.time < window_.first || !bounds.admits(knots_[k].at(side))) continue;
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
      if (out.count == 0) continue;  // the knots on both sides say the same
      for (const Micros time : {fine.first, fine.last})
        look_at(bounds, {time, Side::after, base_inside(k, time), knots_[k].reset_after}, window_);
    }
  }
}

void Search::keep_pre(const Bounds& bounds) {
  for (std::size_t k = 0; k < knots_.size() && knots_[k].time <= window_.last; ++k) {
    const Micros time = knots_[k].time;
    if (time >= window_.first && !bounds.admits(knots_[k].between)) bad_.push_back({time, time});
    if (k + 1 == knots_.size()) break;
    const Stretch starts = common(interior(k), window_);
    if (starts.last < starts.first) continue;
    const Outside out = outside(bounds, base_inside(k, starts.first), knots_[k].rate, starts);
    bad_.insert(bad_.end(), out.parts.begin(), out.parts.begin() + static_cast<std::ptrdiff_t>(out.count));
  }
}

void Search::keep_maintenance(const Bounds& bounds) {
  const Micros duration = effect_.duration;
  if (duration == 0) return;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const Micros time = knots_[k].time;
    look_at(bounds, at_knot(k, Side::before), {time - duration, time - 1});
    look_at(bounds, at_knot(k, Side::between), {time - duration + 1, time - 1});
    look_at(bounds, at_knot(k, Side::after), {time - duration + 1, time});
    if (k + 1 == knots_.size() || interior(k).last < interior(k).first) continue;
    look_at_start(bounds, k, interior(k));
    look_at_end(bounds, k, interior(k), Side::before);
  }
}

void Search::keep_post(const Bounds& bounds) {
  const Micros duration = effect_.duration;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
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

void Search::keep(const Constraint& constraint, const Bounds& bounds) {
  if (constraint.phase == Phase::pre) keep_pre(bounds);
  if (constraint.phase == Phase::maintenance) keep_maintenance(bounds);
  if (constraint.phase == Phase::post) keep_post(bounds);
}

}  // namespace

bool Effect::none() const {
  const auto nothing = [](const Step& step) { return !step.assign && step.delta == 0 && step.rate == 0; };
  return nothing(start) && nothing(end);
}

Effect effect_on(Index timeline, const Footprint& footprint) {
  Effect effect;
  effect.duration = footprint.duration.count();
  for (const Impact& impact : footprint.impacts) {
    if (impact.timeline != timeline) continue;
    Effect::Step step;
    if (impact.kind == ImpactKind::assign) step.assign = exact_amount(impact.amount);
    if (impact.kind == ImpactKind::delta) step.delta = exact_amount(impact.amount);
    if (impact.kind == ImpactKind::rate) step.rate = exact_rate(impact.amount);
    join(impact.moment == ImpactWhen::at_end ? effect.end : effect.start, step);
    if (impact.moment == ImpactWhen::during) join(effect.end, {{}, -step.delta, -step.rate});
  }
  if (effect.duration == 0) {
    join(effect.start, effect.end);
    effect.end = {};
  }
  return effect;
}

Bounds bounds_of(const Constraint& constraint) {
  return {exact_amount(constraint.lowest), exact_amount(constraint.highest), constraint.states};
}

Outside outside(const Bounds& bounds, Exact at_first, Exact rate, Stretch stretch) {
  Outside out;
  const Exact length = stretch.last - stretch.first;
  const bool first_fine = bounds.admits(at_first);
  if (bounds.states != 0 || rate == 0) {
    if (!first_fine) out.parts[out.count++] = stretch;
    return out;
  }
  if (first_fine && bounds.admits(at_first + rate * length)) return out;
  // Mirrored where it falls, the value rises from below the lowest through the bounds to above the highest.
  const Exact value = rate > 0 ? at_first : -at_first;
  const Exact rise = rate > 0 ? rate : -rate;
  const Exact lowest = rate > 0 ? bounds.lowest : -bounds.highest;
  const Exact highest = rate > 0 ? bounds.highest : -bounds.lowest;
  const Exact below = value < lowest ? (lowest - value + rise - 1) / rise : 0;  // so many steps are too low
  const Exact fine = value <= highest ? (highest - value) / rise + 1 : 0;       // from this step on it is too high
  if (below > 0) out.parts[out.count++] = {stretch.first, stretch.first + static_cast<Micros>(std::min(below - 1, length))};
  const Exact above = std::max(below, fine);
  if (above <= length) out.parts[out.count++] = {stretch.first + static_cast<Micros>(above), stretch.last};
  return out;
}

void find_bad_starts(const Line& line, const Effect& effect, std::span<const Constraint* const> own,
                     Stretch window, std::vector<Stretch>& bad) {
  Search search(line, effect, window, bad);
  for (const Constraint* constraint : own) search.keep(*constraint, bounds_of(*constraint));
  if (effect.none()) return;
  search.keep_for_others(line.range(), {line.past(), Side::before}, {line.end(), Side::after});
  for (const Ask& ask : line.asks()) search.keep_for_others(ask.bounds, ask.from, ask.to);
}

}  // namespace roci::temporal::timelines
