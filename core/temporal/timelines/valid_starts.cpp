#include <algorithm>
#include <stdexcept>
#include <string>

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

std::vector<Interval> Timelines::valid_starts(const Footprint& footprint, Interval window) const {
  if (!permitted(definitions_, footprint)) {
    std::string text;
    for (const std::string& fault : check(definitions_, footprint)) text += (text.empty() ? "" : "; ") + fault;
    throw std::invalid_argument(text);
  }
  const Stretch starts{std::max(window.earliest.count(), past_),
                       std::min(window.latest.count(), end_ - footprint.duration.count())};
  if (starts.last < starts.first) return {};
  std::vector<Stretch> bad;
  std::vector<const Constraint*> own;
  for (const Index timeline : touched_by(footprint)) {
    own.clear();
    for (const Constraint& constraint : footprint.constraints)
      if (constraint.timeline == timeline) own.push_back(&constraint);
    find_bad_starts(lines_[timeline], effect_on(timeline, footprint), own, starts, bad);
  }
  return without(starts, bad);
}

std::optional<Time> Timelines::first_valid_start(const Footprint& footprint, Interval window) const {
  const std::vector<Interval> starts = valid_starts(footprint, window);
  if (starts.empty()) return std::nullopt;
  return starts.front().earliest;
}

}  // namespace roci::temporal::timelines
