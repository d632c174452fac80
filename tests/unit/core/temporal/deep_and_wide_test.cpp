// Long chains and wide fans of time points on a small stack: nothing here recurses as deep as a network has points.
#include <gtest/gtest.h>

#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/execution_windows.hpp"
#include "core/temporal/network_distances.hpp"
#include "core/temporal/schedule.hpp"
#include "core/temporal/stn.hpp"
#include "tests/unit/small_stack.hpp"

namespace roci::temporal {
namespace {

using roci::small_stack::on_small_stack;

constexpr TimePoint kMany = 20'000;
constexpr std::size_t kStack = 64 * 1024;  // bytes

// Each point one microsecond or two after the one before.
std::vector<TemporalConstraint> chain() {
  std::vector<TemporalConstraint> out;
  for (TimePoint p = 1; p < kMany; ++p)
    out.push_back({p - 1, p, ConstraintKind::ordering, Duration{1}, Duration{2}});
  return out;
}

const Window kEnd{Duration{kMany - 1}, Duration{2 * (kMany - 1)}};

TEST(DeepAndWide, AChainOfTimePointsIsScheduled) {
  on_small_stack(
      [] {
        const auto schedule = earliest_schedule(kMany, chain());
        ASSERT_TRUE(schedule.has_value());
        EXPECT_EQ(schedule->back(), kEnd.lower);
        EXPECT_EQ(NetworkDistances(kMany, chain()).between(0, kMany - 1), kEnd);
      },
      kStack);
}

TEST(DeepAndWide, AChainOfTimePointsIsPropagated) {
  on_small_stack(
      [] {
        Stn stn(kMany);
        // From the end to the beginning, so that the last constraint moves every window.
        for (TimePoint p = kMany - 1; p > 0; --p) ASSERT_TRUE(stn.add(p - 1, p, Duration{1}, Duration{2}));
        EXPECT_EQ(stn.window(kMany - 1), kEnd);
        EXPECT_FALSE(stn.add(0, kMany - 1, Duration{0}, Duration{kMany - 2}));
      },
      kStack);
}

TEST(DeepAndWide, AChainOfTimePointsIsExecuted) {
  on_small_stack(
      [] {
        ExecutionWindows windows(kMany, chain(), Time{0});
        EXPECT_EQ(windows.window(kMany - 1), kEnd);
        windows.happen(1, Time{2});  // every window behind it moves
        EXPECT_EQ(windows.window(kMany - 1).lower, kEnd.lower + Duration{1});
      },
      kStack);
}

TEST(DeepAndWide, AFanOfTimePointsIsExecuted) {
  on_small_stack(
      [] {
        std::vector<TemporalConstraint> fan;
        for (TimePoint p = 1; p < kMany; ++p)
          fan.push_back({0, p, ConstraintKind::ordering, Duration{1}, Duration{2}});
        ExecutionWindows windows(kMany, fan, Time{0});
        windows.settle();
        for (TimePoint p = 1; p < kMany; ++p)
          ASSERT_EQ(windows.window(p), (Window{Duration{1}, Duration{2}})) << p;
      },
      kStack);
}

TEST(DeepAndWide, ADeepConditionIsEvaluated) {
  on_small_stack(
      [] {
        Condition deep;
        for (TimePoint i = 0; i < kMany; ++i) deep.nodes.push_back({ConditionOp::negation, 1, {}, {}});
        for (const ConditionNode& leaf : compare("t", ConditionOp::eq, true).nodes)
          deep.nodes.push_back(leaf);
        EXPECT_EQ(evaluate(deep, [](const std::string&) { return std::optional<Value>(true); }), Truth::yes);
      },
      kStack);
}

}  // namespace
}  // namespace roci::temporal
