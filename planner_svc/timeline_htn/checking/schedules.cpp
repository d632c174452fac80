#include <algorithm>
#include <numeric>
#include <random>

#include "core/temporal/stn.hpp"
#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

namespace {

// Corners and random schedules have together about so many points, so that large plans are executed less often.
constexpr std::size_t kPoints = 30'000;

std::size_t count_for(const Version& version) {
  return std::clamp<std::size_t>(kPoints / version.plan.point_count, 4, 400);
}

Schedule bounds_as_schedule(const temporal::Stn& network, bool latest) {
  Schedule out;
  for (TimePoint p = 0; p < network.size(); ++p)
    out.push_back(latest ? network.window(p).upper : network.window(p).lower);
  return out;
}

Schedule random_schedule(temporal::Stn network, std::mt19937_64& random) {
  std::vector<TimePoint> order(network.size());
  std::iota(order.begin(), order.end(), TimePoint{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  for (const TimePoint point : order) {
    const temporal::Window window = network.window(point);
    const auto width = static_cast<std::uint64_t>((window.upper - window.lower).count());
    const Duration at = window.lower + Duration{static_cast<std::int64_t>(random() % (width + 1))};
    static_cast<void>(network.add(temporal::origin_point, point, at, at));  // it lies in the window
  }
  return bounds_as_schedule(network, false);
}

}  // namespace

// What nothing bounds from above happens by the horizon, or as soon behind it as it can.
std::vector<Schedule> schedules(const Version& version) {
  temporal::Stn network(version.plan.point_count);
  for (const temporal::TemporalConstraint& c : all_constraints(version.plan))
    static_cast<void>(network.add(c.from_point, c.to_point, c.lower, c.upper));  // they were found consistent
  const Duration horizon = version.model.problem->horizon;
  for (TimePoint p = 1; p < version.plan.point_count; ++p) {
    const Duration earliest = network.window(p).lower;
    static_cast<void>(network.add(temporal::origin_point, p, Duration{0}, std::max(horizon, earliest)));
  }
  std::vector<Schedule> out{bounds_as_schedule(network, false), bounds_as_schedule(network, true)};
  const std::size_t count = count_for(version);
  const std::size_t step = std::max<std::size_t>(1, 2 * version.plan.point_count / count);
  for (TimePoint p = 1; p < version.plan.point_count; p += static_cast<TimePoint>(step))
    for (const bool latest : {false, true}) {
      temporal::Stn corner = network;
      const Duration at = latest ? corner.window(p).upper : corner.window(p).lower;
      static_cast<void>(corner.add(temporal::origin_point, p, at, at));
      out.push_back(bounds_as_schedule(corner, !latest));
    }
  std::mt19937_64 random(version.plan.point_count);
  for (std::size_t i = 0; i < count; ++i) out.push_back(random_schedule(network, random));
  return out;
}

}  // namespace roci::planner::timeline_htn::checking
