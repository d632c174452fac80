#include <algorithm>

#include "core/temporal/timelines/check.hpp"
#include "core/temporal/timelines/effect.hpp"
#include "core/temporal/timelines/placement.hpp"
#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

/// Is what a task does to one timeline and asks of it.
struct Touch {
  Index timeline = 0;
  Effect effect;
  std::vector<const Constraint*> own;
};

/// Returns the timelines that a task touches, each once; first those of which it asks
/// something, since they refuse most.
std::vector<Touch> touched_by(const Footprint& footprint) {
  std::vector<Touch> touched;
  const auto of = [&](Index timeline) -> Touch& {
    const auto known = std::ranges::find(touched, timeline, &Touch::timeline);
    if (known != touched.end()) return *known;
    return touched.emplace_back(Touch{timeline, effect_on(timeline, footprint), {}});
  };
  for (const Constraint& constraint : footprint.constraints)
    of(constraint.timeline).own.push_back(&constraint);
  for (const Impact& impact : footprint.impacts) of(impact.timeline);
  return touched;
}

/// Returns what is left of the window without the bad stretches.
std::vector<Interval> without(Stretch window, std::vector<Stretch>& bad) {
  std::ranges::sort(bad, {}, &Stretch::first);
  std::vector<Interval> left;
  Micros first = window.first;
  for (const Stretch& stretch : bad) {
    if (stretch.first > first) left.push_back({Time{first}, Time{std::min(stretch.first - 1, window.last)}});
    first = std::max(first, stretch.last + 1);
  }
  if (first <= window.last) left.push_back({Time{first}, Time{window.last}});
  return left;
}

/// Returns the first time from `first` on that no bad stretch covers.
Micros first_without(Micros first, std::vector<Stretch>& bad) {
  std::ranges::sort(bad, {}, &Stretch::first);
  for (const Stretch& stretch : bad) {
    if (stretch.first > first) break;
    first = std::max(first, stretch.last + 1);
  }
  return first;
}

}  // namespace

/// Returns the part of the window in which the task lies between the past and the end; it may be empty.
Stretch Timelines::possible_starts(const Footprint& footprint, Interval window) const {
  refuse_faults(definitions_, footprint);
  return {std::max(window.earliest.count(), past_),
          std::min(window.latest.count(), end_ - footprint.duration.count())};
}

std::vector<Interval> Timelines::valid_starts(const Footprint& footprint, Interval window) const {
  const Stretch starts = possible_starts(footprint, window);
  if (starts.last < starts.first) return {};
  std::vector<Stretch>& bad = scratch_.bad;
  bad.clear();
  for (const Touch& touch : touched_by(footprint))
    find_bad_starts(lines_[touch.timeline], touch.effect, touch.own, starts, bad, scratch_);
  return without(starts, bad);
}

// A start that one timeline refuses is not looked at on the others: so short timelines are asked about the whole window
// first, and long ones only from there on, in parts of the window that grow. Most tasks find their place in the first,
// and the last cost no more than the whole.
std::optional<Time> Timelines::first_valid_start(const Footprint& footprint, Interval window) const {
  constexpr std::size_t kShort = 2;  // blocks
  Stretch starts = possible_starts(footprint, window);
  if (starts.last < starts.first) return std::nullopt;
  const std::vector<Touch> touched = touched_by(footprint);
  std::vector<Stretch>& bad = scratch_.bad;
  bad.clear();
  const auto refuse = [&](const Touch& touch, Stretch part) {
    find_bad_starts(lines_[touch.timeline], touch.effect, touch.own, part, bad, scratch_);
    return first_without(part.first, bad);
  };
  bool any_long = false;
  for (const Touch& touch : touched) {
    const bool is_long = lines_[touch.timeline].blocks() > kShort;
    any_long |= is_long;
    if (!is_long) starts.first = refuse(touch, starts);
    if (starts.first > starts.last) return std::nullopt;
  }
  if (!any_long) return Time{starts.first};
  const std::vector<Stretch> by_short = bad;
  Micros length = std::max<Micros>((starts.last - starts.first) / 64, 1);
  for (Micros first = starts.first; first <= starts.last; first += length + 1, length *= 4) {
    Stretch part{first, std::min(first + length, starts.last)};
    bad = by_short;
    part.first = first_without(part.first, bad);
    for (const Touch& touch : touched) {
      if (part.first > part.last) break;
      if (lines_[touch.timeline].blocks() > kShort) part.first = refuse(touch, part);
    }
    if (part.first <= part.last) return Time{part.first};
  }
  return std::nullopt;
}

}  // namespace roci::temporal::timelines
