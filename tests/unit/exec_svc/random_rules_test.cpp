// Rule-based random testing: goals, failures, delays, deaths, lies and clock jumps in any order.
#include "tests/unit/exec_svc/random_world.hpp"

namespace roci::exec::testing {
namespace {

TEST(RandomRules, WhateverHappensNoInvariantBreaksAndEveryGoalEnds) {
  std::map<std::string, int> events;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomWorld world(seed);
    world.run();
    for (const auto& [event, count] : world.events) events[event] += count;
    if (HasFailure()) return;
  }
  for (const char* event : {"goal.achieved", "goal.dropped", "goal.failed", "goal.recalled", "goal.rejected",
                            "plan.broken", "plan.kept", "plan.retry", "plan.outdated", "recovery.push",
                            "recovery.retry", "recovery.contingency", "robot.safe", "service.lost"})
    EXPECT_GT(events[event], 20) << event;
}

}  // namespace
}  // namespace roci::exec::testing
