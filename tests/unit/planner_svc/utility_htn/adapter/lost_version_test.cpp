// Versions that no executive has answered: it died before it took them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/engine/version_exchange.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using engine::StepInputs, engine::StepOutput;
using temporal::Time;
using ::testing::ElementsAre;

class LostVersion : public ::testing::Test {
 protected:
  StepInputs at(Time now) {
    StepInputs out;
    out.now = now;
    return out;
  }

  StepInputs receipt(Time now, std::uint32_t version, std::uint32_t refused = 0) {
    exchange_.hear({version, refused, "", "", true});
    return at(now);
  }

  // Returns the version that the step's change starts from; nothing if there is none.
  std::optional<std::uint32_t> base_after(StepInputs inputs) {
    exchange_.give(inputs);
    const StepOutput out = engine_.step(inputs);
    if (!out.delta) return std::nullopt;
    temporal::FlexiblePlan next;
    EXPECT_EQ(exchange_.apply(*out.delta, next), "");
    exchange_.sent(next);
    return out.delta->from_version;
  }

  StepInputs beginning() {
    StepInputs out = receipt(Time{0}, 0);
    engine::Goal mission;
    mission.issuer = "ground";
    mission.id = mission.kind = "mission";
    out.goals.push_back(mission);
    return out;
  }

  UtilityEngine engine_{{"utility_htn", "lander", "", {}}, testing::toy_network()};
  engine::VersionExchange exchange_;
};

TEST_F(LostVersion, IsSentAnewAgainstTheOneThatTheExecutiveHas) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  ASSERT_EQ(base_after(at(10s)), 1U) << "what starts first is committed";
  EXPECT_EQ(base_after(at(20s)), 1U) << "nobody has taken version 2";
  base_after(receipt(21s, 3));
  EXPECT_NE(base_after(at(30s)), 1U);
}

TEST_F(LostVersion, AWholePlanComesWholeAgain) {
  ASSERT_EQ(base_after(beginning()), 0U);
  EXPECT_EQ(base_after(at(10s)), 0U);
  base_after(receipt(11s, 2));
  EXPECT_NE(base_after(at(20s)), 0U);
}

TEST_F(LostVersion, AReceiptThatComesLateSaysWhatTheExecutiveHas) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  ASSERT_EQ(base_after(at(10s)), 1U);
  ASSERT_EQ(base_after(at(20s)), 1U);
  base_after(receipt(21s, 2, 3));  // it had version 2, and so refused the change of version 1
  EXPECT_NE(base_after(at(30s)), 1U);
  const auto next = base_after(at(40s));
  EXPECT_GE(next.value_or(2), 2U);
}

// It takes the first of many, when it is no longer busy, and refuses the others.
TEST_F(LostVersion, OfManyWithoutAnAnswerAnyMayBeTaken) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  for (int i = 1; i <= 6; ++i) ASSERT_EQ(base_after(at(i * 10s)), 1U);
  base_after(receipt(61s, 2, 7));
  for (int i = 7; i <= 9; ++i) EXPECT_GE(base_after(at(i * 10s)).value_or(2), 2U);
}

TEST_F(LostVersion, AReceiptFromBeforeThePlanWasTakenChangesNothing) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 0));
  base_after(receipt(2s, 1));
  EXPECT_EQ(base_after(at(10s)), 1U);
}

TEST_F(LostVersion, AfterAPlanThatEndedTheNextOneComesWhole) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  ASSERT_EQ(base_after(at(10s)), 1U);
  base_after(receipt(12s, 0, 2));  // it had ended, and so it refused the change
  EXPECT_EQ(base_after(at(20s)).value_or(0), 0U);
  EXPECT_EQ(base_after(at(30s)).value_or(0), 0U);
}

TEST_F(LostVersion, WhatIsRefusedIsSentAgainAfterAWhile) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  ASSERT_EQ(base_after(at(10s)), 1U);
  base_after(receipt(11s, 1, 2));
  EXPECT_EQ(base_after(at(20s)), std::nullopt);
  EXPECT_EQ(base_after(at(40s)), 1U);
  base_after(receipt(41s, 3));
  EXPECT_EQ(base_after(at(50s)), std::nullopt);
}

// Behind the highest number there is no version could follow.
TEST_F(LostVersion, ANumberThatCannotHaveBeenReachedIsNotBelieved) {
  ASSERT_EQ(base_after(beginning()), 0U);
  base_after(receipt(1s, 1));
  exchange_.note(4'294'967'295);
  base_after(receipt(2s, 4'294'967'295));
  base_after(receipt(3s, 1, 4'294'967'295));
  temporal::FlexiblePlan forged;
  forged.version = 4'294'967'295;
  EXPECT_FALSE(exchange_.take(forged));
  ASSERT_EQ(base_after(at(10s)), 1U) << "what starts first is committed";
  EXPECT_EQ(exchange_.last_version(), 2U);
  exchange_.note(engine::VersionExchange::kHighestTold);
  EXPECT_TRUE(base_after(at(20s))) << "there is room behind what is believed";
  EXPECT_EQ(exchange_.last_version(), engine::VersionExchange::kHighestTold + 1);
}

TEST_F(LostVersion, StepsTellWhatTheirCycleDid) {
  StepInputs first = beginning();
  exchange_.give(first);
  const StepOutput whole = engine_.step(first);
  EXPECT_THAT(whole.account.parts, ElementsAre("schedule"));
  temporal::FlexiblePlan plan;
  ASSERT_EQ(exchange_.apply(*whole.delta, plan), "");
  exchange_.sent(plan);
  base_after(receipt(1s, 1));
  const StepOutput second = engine_.step(at(10s));
  ASSERT_FALSE(second.account.parts.empty());
  EXPECT_EQ(second.account.parts.front(), "commit");
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
