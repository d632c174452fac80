#include "tests/unit/exec_svc/executive/random_plan.hpp"

#include <string>
#include <vector>

namespace roci::exec::testing {

using temporal::ConstraintKind;
using temporal::Duration;
using temporal::no_bound;
using temporal::TimePoint;

std::int64_t between(std::mt19937_64& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

temporal::FlexiblePlan random_plan(std::mt19937_64& random, std::size_t most) {
  const auto ms = [](std::int64_t count) { return Duration{count * 1000}; };
  const auto one_in = [&](std::uint64_t n) { return random() % n == 0; };
  temporal::FlexiblePlan plan;
  std::vector<Duration> hidden{Duration{0}};  // a time for every point
  const auto count = static_cast<std::size_t>(between(random, 1, static_cast<std::int64_t>(most)));
  for (std::size_t i = 0; i < count; ++i) {
    temporal::PlanActivity activity;
    activity.id = std::string("a") + std::to_string(i);
    if (!one_in(4)) {
      activity.owner = "sim";
      activity.command_name = "work";
    }
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    const Duration start = ms(between(random, 0, 500));
    const Duration lasts = ms(between(random, 1, 200));
    hidden.push_back(start);
    hidden.push_back(start + lasts);
    activity.duration_lower = one_in(3) ? lasts : std::max(Duration{0}, lasts - ms(between(random, 0, 80)));
    activity.duration_upper = one_in(6) ? no_bound : lasts + ms(one_in(3) ? 0 : between(random, 0, 80));
    plan.activities.push_back(activity);
  }
  for (std::int64_t c = between(random, 0, 3 * static_cast<std::int64_t>(count)); c > 0; --c) {
    auto from = static_cast<TimePoint>(between(random, 0, plan.point_count - 1));
    auto to = static_cast<TimePoint>(between(random, 0, plan.point_count - 1));
    if (hidden[from] > hidden[to]) std::swap(from, to);
    const Duration distance = hidden[to] - hidden[from];
    if (from == to || to == temporal::origin_point || distance == Duration{0}) continue;
    const Duration lower = one_in(2) ? ms(1) : Duration{distance.count() * between(random, 0, 100) / 100};
    const Duration upper = one_in(2) ? no_bound : distance + ms(between(random, 0, 100));
    const auto kind = from == temporal::origin_point ? ConstraintKind::window : ConstraintKind::ordering;
    plan.constraints.push_back({from, to, kind, std::min(lower, distance), upper});
  }
  return plan;
}

}  // namespace roci::exec::testing
