// The course of timelines: where bounds are broken, and the corners to draw.
#include <algorithm>

#include "core/temporal/timelines/placement.hpp"
#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

/// Collects stretches in the order of time; those that touch become one.
class Stretches {
 public:
  void add(Stretch stretch) {
    if (!all_.empty() && stretch.first <= all_.back().last + 1) {
      all_.back().last = std::max(all_.back().last, stretch.last);
    } else {
      all_.push_back(stretch);
    }
  }
  const std::vector<Stretch>& all() const { return all_; }

 private:
  std::vector<Stretch> all_;
};

/// Returns where the bounds are broken between the two positions, at which knots stand.
std::vector<Stretch> broken(std::span<const Knot> knots, const Bounds& bounds, Position from, Position to) {
  Stretches stretches;
  const auto first = std::ranges::lower_bound(knots, from.time, {}, &Knot::time);
  for (auto knot = first; knot != knots.end() && knot->time <= to.time; ++knot) {
    for (const Side side : {Side::before, Side::between, Side::after}) {
      const Position here{knot->time, side};
      if (here >= from && here <= to && !bounds.admits(knot->at(side))) stretches.add({knot->time, knot->time});
    }
    if (knot->time >= to.time || std::next(knot) == knots.end()) continue;
    const Stretch inside{knot->time + 1, std::next(knot)->time - 1};
    if (inside.last < inside.first) continue;
    const Outside out = outside(bounds, knot->after + knot->rate, knot->rate, inside);
    for (std::size_t i = 0; i < out.count; ++i) stretches.add(out.parts[i]);
  }
  return stretches.all();
}

}  // namespace

std::vector<Conflict> Timelines::conflicts(Time from, Time to) const {
  std::vector<Conflict> conflicts;
  for (Index timeline = 0; timeline < lines_.size(); ++timeline) {
    const Line& line = lines_[timeline];
    const std::vector<Knot> knots = line.knots();
    const auto begin = static_cast<std::ptrdiff_t>(conflicts.size());
    const auto add = [&](const Bounds& bounds, Position first, Position last, std::optional<TaskId> task,
                         std::size_t constraint) {
      if (last.time < from.count() || first.time > to.count()) return;
      for (const Stretch& stretch : broken(knots, bounds, first, last))
        if (stretch.last >= from.count() && stretch.first <= to.count())
          conflicts.push_back({timeline, task, constraint, Time{stretch.first}, Time{stretch.last}});
    };
    add(line.range(), {line.past(), Side::before}, {line.end(), Side::after}, std::nullopt, 0);
    for (const Ask& ask : line.asks()) add(ask.bounds, ask.from, ask.to, ask.task, ask.constraint);
    std::sort(conflicts.begin() + begin, conflicts.end(), [](const Conflict& a, const Conflict& b) {
      return std::tie(a.from, a.task, a.constraint) < std::tie(b.from, b.task, b.constraint);
    });
  }
  return conflicts;
}

std::vector<Vertex> Timelines::trajectory(Index timeline, Time from, Time to) const {
  const Line& line = lines_.at(timeline);
  const Micros first = std::clamp(from.count(), past_, end_);
  const Micros last = std::clamp(to.count(), first, end_);
  std::vector<Vertex> corners;
  const auto add = [&](Micros time, double value, bool observed) {
    const Vertex corner{Time{time}, value, observed};
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  };
  add(first, value(timeline, Time{first}), false);
  for (const Knot& knot : line.knots()) {
    if (knot.time < first || knot.time > last) continue;
    const bool observed = knot.reset_after.time == knot.time && knot.reset_after.turn == Turn::observed;
    if (knot.time > first) add(knot.time, to_number(knot.before), false);
    if (knot.between != knot.before) add(knot.time, to_number(knot.between), false);
    add(knot.time, to_number(knot.after), observed);
  }
  add(last, value(timeline, Time{last}), corners.back().observed && corners.back().time.count() == last);
  return corners;
}

}  // namespace roci::temporal::timelines
