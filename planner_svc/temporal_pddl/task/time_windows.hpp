// Time windows are sets of times as intervals, which say when a snap action may happen.
#pragma once

#include <span>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::planner::temporal_pddl::task {

/// Holds an interval of times, both ends included.
struct TimeWindow {
  temporal::Duration open{0};
  temporal::Duration close = temporal::no_bound;
  bool operator==(const TimeWindow&) const = default;
};

/// Holds disjoint intervals in ascending order.
using TimeWindows = std::vector<TimeWindow>;

/// Returns the one window that holds every time.
inline TimeWindows any_time() { return {TimeWindow{}}; }
inline bool is_any_time(std::span<const TimeWindow> windows) {
  return windows.size() == 1 && windows.front() == TimeWindow{};
}

/// Returns the times that lie in both.
TimeWindows intersection(std::span<const TimeWindow> a, std::span<const TimeWindow> b);

/// Cuts each window by `from_open` and `from_close` at its ends, where it has them, and returns what is
/// left.
TimeWindows shrunk(std::span<const TimeWindow> windows, temporal::Duration from_open,
                   temporal::Duration from_close);

/// Returns the first window that is not over at `time`, or null if all are.
const TimeWindow* window_from(std::span<const TimeWindow> windows, temporal::Duration time);

}  // namespace roci::planner::temporal_pddl::task
