#include "planner_svc/temporal_pddl/task/time_windows.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::task {

using temporal::Duration;
using temporal::no_bound;

TimeWindows intersection(std::span<const TimeWindow> a, std::span<const TimeWindow> b) {
  TimeWindows result;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const Duration open = std::max(a[i].open, b[j].open);
    const Duration close = std::min(a[i].close, b[j].close);
    if (open <= close) result.push_back({open, close});
    (a[i].close < b[j].close ? i : j)++;
  }
  return result;
}

TimeWindows shrunk(std::span<const TimeWindow> windows, Duration from_open, Duration from_close) {
  TimeWindows result;
  for (TimeWindow window : windows) {
    if (window.open > Duration{0}) window.open += from_open;
    if (window.close != no_bound) window.close -= from_close;
    if (window.open <= window.close) result.push_back(window);
  }
  return result;
}

const TimeWindow* window_from(std::span<const TimeWindow> windows, Duration time) {
  const auto found = std::ranges::lower_bound(windows, time, {}, &TimeWindow::close);
  return found == windows.end() ? nullptr : &*found;
}

}  // namespace roci::planner::temporal_pddl::task
