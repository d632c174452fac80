// Sets of times as intervals: when a snap action may happen.
#pragma once

#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

// Both ends belong to it.
struct TimeWindow {
  Duration open{0};
  Duration close = kUnbounded;
  bool operator==(const TimeWindow&) const = default;
};

// Ascending and disjoint.
using TimeWindows = std::vector<TimeWindow>;

inline TimeWindows any_time() { return {TimeWindow{}}; }
inline bool is_any_time(std::span<const TimeWindow> windows) {
  return windows.size() == 1 && windows.front() == TimeWindow{};
}

TimeWindows intersection(std::span<const TimeWindow> a, std::span<const TimeWindow> b);

// Each window cut by `from_open` and `from_close` at its ends, where it has them; what is left of them.
TimeWindows shrunk(std::span<const TimeWindow> windows, Duration from_open, Duration from_close);

// The first window that is not over at `time`; null if all are.
const TimeWindow* window_from(std::span<const TimeWindow> windows, Duration time);

}  // namespace roci::planner::temporal_pddl
