#include "services/link/schedule.hpp"

#include <algorithm>

namespace roci::services::link {

using temporal::Time;

namespace {

// The parts of `open` that the cut leaves.
void cut_out(std::vector<Interval>& open, const Interval& cut) {
  std::vector<Interval> left;
  for (const Interval& interval : open) {
    if (interval.first < cut.first) left.emplace_back(interval.first, std::min(interval.second, cut.first));
    if (interval.second > cut.second)
      left.emplace_back(std::max(interval.first, cut.second), interval.second);
  }
  open = std::move(left);
}

}  // namespace

Schedule::Schedule() : intervals_{{-temporal::no_bound, temporal::no_bound}} {}

Schedule::Schedule(std::vector<Interval> windows, const std::vector<Interval>& cuts) {
  if (windows.empty()) windows.emplace_back(-temporal::no_bound, temporal::no_bound);
  for (const Interval& window : windows) {
    if (!intervals_.empty() && intervals_.back().second == window.first) {
      intervals_.back().second = window.second;
    } else {
      intervals_.push_back(window);
    }
  }
  for (const Interval& cut : cuts) cut_out(intervals_, cut);
}

bool Schedule::open(Time time) const { return closes(time) > time; }

std::optional<Time> Schedule::next_open(Time from) const {
  const auto next = std::ranges::upper_bound(intervals_, from, {}, &Interval::second);
  if (next == intervals_.end()) return std::nullopt;
  return std::max(from, next->first);
}

Time Schedule::closes(Time time) const {
  const auto next = std::ranges::upper_bound(intervals_, time, {}, &Interval::second);
  return next == intervals_.end() || time < next->first ? time : next->second;
}

}  // namespace roci::services::link
