#include "bench/executive/plans.hpp"

#include <algorithm>
#include <stdexcept>

namespace roci::bench {
namespace {

using temporal::ConstraintKind;
using temporal::Duration;
using temporal::FlexiblePlan;
using temporal::no_bound;
using temporal::seconds;

constexpr std::size_t kFanWidth = 8;

void add_activity(FlexiblePlan& plan) {
  temporal::PlanActivity activity;
  activity.id = activity.name = "a" + std::to_string(plan.activities.size());
  activity.owner = activity.subsystem = "sim";
  activity.command_name = "work";
  activity.start_point = plan.point_count++;
  activity.end_point = plan.point_count++;
  activity.duration_lower = seconds(10);
  activity.duration_upper = seconds(12);
  plan.activities.push_back(std::move(activity));
}

void after(FlexiblePlan& plan, std::size_t earlier, std::size_t later, Duration most = no_bound) {
  plan.constraints.push_back({plan.activities[earlier].end_point, plan.activities[later].start_point,
                              ConstraintKind::ordering, seconds(0.001), most});
}

void join_chain(FlexiblePlan& plan, Duration most) {
  for (std::size_t i = 1; i < plan.activities.size(); ++i) after(plan, i - 1, i, most);
}

// Puts groups of kFanWidth in parallel; the first activity of a group follows all of the group before it.
void join_fan(FlexiblePlan& plan) {
  for (std::size_t i = 1; i < plan.activities.size(); ++i) {
    const std::size_t place = i % (kFanWidth + 1);
    if (place != 0) {
      after(plan, i - place, i);
      continue;
    }
    for (std::size_t before = i - kFanWidth; before < i; ++before) after(plan, before, i);
  }
}

void join_random(FlexiblePlan& plan, std::mt19937_64& random) {
  for (std::size_t i = 1; i < plan.activities.size(); ++i) {
    for (std::uint64_t links = 1 + random() % 3; links > 0; --links) {
      const std::size_t reach = std::min<std::size_t>(i, 20);
      const Duration most = random() % 10 == 0 ? seconds(3600) : no_bound;
      after(plan, i - 1 - random() % reach, i, most);
    }
  }
}

}  // namespace

const std::vector<std::string>& shapes() {
  static const std::vector<std::string> all{"chain", "rigid", "fan", "random"};
  return all;
}

FlexiblePlan plan_of(const std::string& shape, std::size_t activities, std::mt19937_64& random) {
  FlexiblePlan plan;
  plan.id = shape;
  for (std::size_t i = 0; i < activities; ++i) add_activity(plan);
  if (shape == "chain") {
    join_chain(plan, no_bound);
  } else if (shape == "rigid") {
    join_chain(plan, seconds(5));
  } else if (shape == "fan") {
    join_fan(plan);
  } else if (shape == "random") {
    join_random(plan, random);
  } else {
    throw std::invalid_argument("unknown shape '" + shape + "'");
  }
  plan.constraints.push_back({temporal::origin_point, plan.activities.back().end_point,
                              ConstraintKind::window, Duration{0},
                              seconds(14.0 * static_cast<double>(activities) + 3600)});
  return plan;
}

}  // namespace roci::bench
