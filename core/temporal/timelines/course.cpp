// The course of timelines: where bounds are broken, and the corners to draw.
#include <algorithm>
#include <tuple>

#include "core/temporal/timelines/placement.hpp"
#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

/// Calls `add` with the stretches between the two positions, at which knots stand, in which the bounds are broken; of
/// the last knot only if `closed`.
template <class Add>
void find_broken(std::span<const Knot> knots, bool closed, const Bounds& bounds, Position from, Position to,
                 Add add) {
  const std::size_t count = knots.size() - (closed ? 0 : 1);
  const auto first = std::ranges::lower_bound(knots, from.time, {}, &Knot::time);
  for (auto k = static_cast<std::size_t>(first - knots.begin()); k < count && knots[k].time <= to.time; ++k) {
    const Knot& knot = knots[k];
    for (const Side side : {Side::before, Side::between, Side::after}) {
      const Position here{knot.time, side};
      if (here >= from && here <= to && !bounds.admits(knot.at(side))) add({knot.time, knot.time});
    }
    if (knot.time >= to.time || k + 1 == knots.size()) continue;
    const Stretch inside{knot.time + 1, knots[k + 1].time - 1};
    if (inside.last < inside.first) continue;
    const Outside out = outside(bounds, knot.after + knot.rate, knot.rate, inside);
    for (std::size_t i = 0; i < out.count; ++i) add(out.parts[i]);
  }
}

/// Makes one of those that follow each other without a gap.
void join(std::vector<Conflict>& conflicts) {
  const auto whose = [](const Conflict& it) {
    return std::tie(it.timeline, it.task, it.constraint, it.from);
  };
  std::ranges::sort(conflicts, {}, whose);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < conflicts.size(); ++i) {
    Conflict& last = conflicts[kept];
    const Conflict& next = conflicts[i];
    const bool same =
        last.timeline == next.timeline && last.task == next.task && last.constraint == next.constraint;
    if (same && next.from.count() <= last.to.count() + 1) {
      last.to = std::max(last.to, next.to);
    } else {
      conflicts[++kept] = next;
    }
  }
  if (!conflicts.empty()) conflicts.resize(kept + 1);
}

}  // namespace

std::vector<Conflict> Timelines::conflicts(Time from, Time to) const {
  std::vector<Conflict> conflicts;
  std::vector<Knot> knots;
  for (Index timeline = 0; timeline < lines_.size(); ++timeline) {
    const Line& line = lines_[timeline];
    for (std::size_t i = 0; i < line.blocks(); ++i) {
      if (line.summary(i).fine) continue;
      line.knots(i, i, knots);
      const bool closed = i + 1 == line.blocks();
      find_broken(knots, closed, line.range(), {line.past(), Side::before}, {line.end(), Side::after},
                  [&](Stretch it) {
                    conflicts.push_back({timeline, std::nullopt, 0, Time{it.first}, Time{it.last}});
                  });
      for (const Ask& ask : line.block(i).asks())
        find_broken(knots, closed, ask.bounds, ask.from, ask.to, [&](Stretch it) {
          conflicts.push_back({timeline, ask.task, ask.constraint, Time{it.first}, Time{it.last}});
        });
    }
  }
  join(conflicts);
  std::erase_if(conflicts, [&](const Conflict& it) { return it.to < from || it.from > to; });
  std::ranges::sort(conflicts, {}, [](const Conflict& it) {
    return std::tie(it.timeline, it.from, it.task, it.constraint);
  });
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
  std::vector<Knot> knots;
  line.knots(line.block_of(first), line.block_of(last), knots);
  const bool closed = line.block_of(last) + 1 == line.blocks();
  for (const Knot& knot : std::span(knots).first(knots.size() - (closed ? 0 : 1))) {
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
