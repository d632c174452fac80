// Versions that no executive has answered: it died before it took them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    out.last_version = last_version_;
    return out;
  }

  StepInputs receipt(Time now, std::uint32_t version, std::uint32_t refused = 0) {
    StepInputs out = at(now);
    out.receipt = engine::Receipt{version, refused, "", "", true};
    return out;
  }

  // Returns the version that the step's change starts from; nothing if there is none.
  std::optional<std::uint32_t> base_after(const StepInputs& inputs) {
    const StepOutput out = engine_.step(inputs);
    if (!out.delta) return std::nullopt;
    last_version_ = out.delta->added.version;
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
  std::uint32_t last_version_ = 0;
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

TEST_F(LostVersion, StepsTellWhatTheirCycleDid) {
  EXPECT_THAT(engine_.step(beginning()).account.parts, ElementsAre("schedule"));
  last_version_ = 1;
  engine_.step(receipt(1s, 1));
  const StepOutput second = engine_.step(at(10s));
  ASSERT_FALSE(second.account.parts.empty());
  EXPECT_EQ(second.account.parts.front(), "commit");
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
