// What an event costs, counted in edges of the network, does not grow with the plan.
#include <gtest/gtest.h>

#include "exec_svc/executive/executive.hpp"
#include "tests/unit/exec_svc/executive/plan_builder.hpp"

namespace roci::exec::testing {

using executive::CommandStage;
using executive::Executive;
using executive::Outputs;

namespace {

using temporal::seconds;
using temporal::Time;

/// A chain of activities of 10 to 12 s; gap_upper < 0: gaps without an upper bound.
temporal::FlexiblePlan chain(int size, double gap_upper) {
  PlanBuilder b;
  for (int i = 0; i < size; ++i) {
    b.activity("a" + std::to_string(i), "sim", 10, 12);
    const auto at = static_cast<std::size_t>(i);
    if (i > 0)
      b.between(b.plan.activities[at - 1].end_point, b.plan.activities[at].start_point, 0.001, gap_upper);
  }
  b.window(b.plan.activities.back().end_point, 0, 20.0 * size);
  return b.plan;
}

/// Edges looked at for the windows per activity, over the first 50 activities, each of them late.
double edges_per_activity(int size, double gap_upper) {
  Executive executive;
  EXPECT_TRUE(executive.load(chain(size, gap_upper), Time{0}).empty());
  constexpr int run = 50;
  Time now{0};
  std::uint64_t before = 0;
  for (int i = 0; i < run; ++i) {
    const std::string id = "a" + std::to_string(i);
    Outputs outputs = executive.step(now, {});
    EXPECT_EQ(outputs.commands.size(), 1U) << i;
    outputs = executive.step(now, {.acks = {{id, 1, CommandStage::accepted, "", ""}}});
    now += seconds(11.5);
    executive.step(now, {.acks = {{id, 1, CommandStage::completed, "", ""}}});
    if (i == 9) before = executive.window_work();  // the first ones forget what the loading had made known
    now += seconds(0.001);
  }
  return static_cast<double>(executive.window_work() - before) / (run - 10);
}

TEST(EventCost, DoesNotGrowWithTheChainBehind) {
  EXPECT_LT(edges_per_activity(5000, -1), 60);
  EXPECT_LT(edges_per_activity(5000, -1), 1.5 * edges_per_activity(100, -1));
}

TEST(EventCost, NorWithOneWhoseGapsAreBoundedSoThatEveryWindowMoves) {
  EXPECT_LT(edges_per_activity(5000, 5), 150);
  EXPECT_LT(edges_per_activity(5000, 5), 1.5 * edges_per_activity(100, 5));
}

}  // namespace
}  // namespace roci::exec::testing
