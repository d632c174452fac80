#include <algorithm>

#include "core/temporal/timelines/check.hpp"
#include "core/temporal/timelines/placement.hpp"
#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

/// Returns the timelines that a task touches, each once.
std::vector<Index> touched_by(const Footprint& footprint) {
  std::vector<Index> touched;
  for (const Impact& impact : footprint.impacts) touched.push_back(impact.timeline);
  for (const Constraint& constraint : footprint.constraints) touched.push_back(constraint.timeline);
  std::ranges::sort(touched);
  touched.erase(std::ranges::unique(touched).begin(), touched.end());
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

}  // namespace

/// Returns the starts within `window` at which the task would break something, in no order.
std::vector<Stretch> Timelines::bad_starts(const Footprint& footprint, Stretch window) const {
  std::vector<Stretch> bad;
  std::vector<const Constraint*> own;
  for (const Index timeline : touched_by(footprint)) {
    own.clear();
    for (const Constraint& constraint : footprint.constraints)
      if (constraint.timeline == timeline) own.push_back(&constraint);
    find_bad_starts(lines_[timeline], effect_on(timeline, footprint), own, window, bad);
  }
  return bad;
}

/// Returns the part of the window in which the task lies between the past and the end; it may be empty.
Stretch Timelines::possible_starts(const Footprint& footprint, Interval window) const {
  refuse_faults(definitions_, footprint);
  return {std::max(window.earliest.count(), past_),
          std::min(window.latest.count(), end_ - footprint.duration.count())};
}

std::vector<Interval> Timelines::valid_starts(const Footprint& footprint, Interval window) const {
  const Stretch starts = possible_starts(footprint, window);
  if (starts.last < starts.first) return {};
  std::vector<Stretch> bad = bad_starts(footprint, starts);
  return without(starts, bad);
}

std::optional<Time> Timelines::first_valid_start(const Footprint& footprint, Interval window) const {
  const Stretch starts = possible_starts(footprint, window);
  // Parts of the window that grow: most tasks find their place in the first, and the last cost no more than the whole.
  Micros length = std::max<Micros>((starts.last - starts.first) / 64, 1);
  for (Micros first = starts.first; first <= starts.last; first += length + 1, length *= 4) {
    const Stretch part{first, std::min(first + length, starts.last)};
    std::vector<Stretch> bad = bad_starts(footprint, part);
    const std::vector<Interval> valid = without(part, bad);
    if (!valid.empty()) return valid.front().earliest;
  }
  return std::nullopt;
}

}  // namespace roci::temporal::timelines
