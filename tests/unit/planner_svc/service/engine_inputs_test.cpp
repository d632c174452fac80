// What an engine that plans all the time hears once, what it hears again, and what finds no room.
#include "planner_svc/engine_inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/limits.hpp"

namespace roci::planner {
namespace {

using engine::GoalState;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

class EngineInputsTest : public ::testing::Test {
 protected:
  static engine::Goal goal(const std::string& id, std::int32_t priority = 0) {
    engine::Goal out;
    out.issuer = "ground";
    out.id = id;
    out.priority = priority;
    return out;
  }
  static engine::StepStatus step(const std::string& activity) { return {1, activity, {}, "", 1}; }
  static engine::DataProduct product(const std::string& id, std::uint64_t bytes = 0) {
    engine::DataProduct out;
    out.id = id;
    out.bytes = bytes;
    return out;
  }
  static temporal::FlexiblePlan plan_of(const std::string& activity) {
    temporal::FlexiblePlan out;
    out.version = 4;
    out.activities.emplace_back().id = activity;
    return out;
  }

  std::vector<std::string> refused_;
  EngineInputs inputs_{[this](const char* what, std::size_t) { refused_.emplace_back(what); }};
};

TEST_F(EngineInputsTest, AGoalIsTheEnginesWhileTheExecutiveCallsItOpen) {
  EXPECT_FALSE(inputs_.hear(goal("image")));
  EXPECT_TRUE(inputs_.hear_status("ground", "image", GoalState::pending));
  EXPECT_FALSE(inputs_.hear_status("ground", "image", GoalState::planned));
  EXPECT_FALSE(inputs_.hear(goal("image")));
  EXPECT_TRUE(inputs_.hear(goal("image", 2)));
  EXPECT_EQ(inputs_.take().goals, (std::vector{goal("image"), goal("image", 2)}));
  EXPECT_TRUE(inputs_.hear_status("ground", "image", GoalState::achieved));
  EXPECT_THAT(inputs_.take().ended_goals, ElementsAre(Field(&engine::EndedGoal::state, GoalState::achieved)));
  EXPECT_FALSE(inputs_.waiting());
  EXPECT_THAT(inputs_.open_goals(), IsEmpty());
}

TEST_F(EngineInputsTest, ResultsCountOnceItIsKnownWhoCommands) {
  EXPECT_FALSE(inputs_.hear("exec_svc", {"drive", 1, 7.0}));
  EXPECT_FALSE(inputs_.hear("another", {"drill", 1}));
  EXPECT_FALSE(inputs_.waiting());
  inputs_.note_executive("exec_svc");
  EXPECT_THAT(inputs_.take().results, ElementsAre(Field(&engine::CommandResult::activity, "drive")));
  EXPECT_FALSE(inputs_.hear("another", {"drill", 2}));
  EXPECT_FALSE(inputs_.hear("exec_svc", {"drive", 1, 7.0}));
  EXPECT_TRUE(inputs_.hear("exec_svc", {"drive", 1, 8.0}));
}

TEST_F(EngineInputsTest, ANewEngineHearsWhatStillCountsAndNoMore) {
  inputs_.hear(goal("image"));
  inputs_.hear_status("ground", "image", GoalState::pending);
  inputs_.hear(goal("sample"));
  inputs_.hear_status("ground", "sample", GoalState::failed);
  inputs_.hear({"battery", temporal::Value{40.0}, temporal::seconds(1)});
  inputs_.hear({"battery", temporal::Value{39.0}, temporal::seconds(2)});
  inputs_.hear(step("drive"));
  inputs_.take();
  inputs_.engine_is_new(temporal::seconds(9));
  const engine::StepInputs again = inputs_.take();
  EXPECT_EQ(again.goals, std::vector{goal("image")});
  ASSERT_EQ(again.observations.size(), 1U);
  EXPECT_EQ(again.observations.front().value, temporal::Value{39.0});
  EXPECT_EQ(again.observations.front().sampled, temporal::seconds(9));
  EXPECT_THAT(again.steps, IsEmpty());
}

TEST_F(EngineInputsTest, AVersionOfAnotherComesWithStepsAndResultsOfItsActivities) {
  inputs_.note_executive("exec_svc");
  for (const char* activity : {"drive", "drill"}) {
    inputs_.hear(step(activity));
    inputs_.hear("exec_svc", {activity, 1});
  }
  inputs_.take();
  engine::StepInputs next;
  next.executed = plan_of("drill");
  inputs_.note_executed(*next.executed);
  inputs_.tell_again(next);
  ASSERT_THAT(next.steps, ElementsAre(Field(&engine::StepStatus::activity, "drill")));
  EXPECT_EQ(next.steps.front().plan_version, 4U);
  EXPECT_THAT(next.results, ElementsAre(Field(&engine::CommandResult::activity, "drill")));
}

TEST_F(EngineInputsTest, ATableThatIsFullTakesWhatItKnows) {
  EXPECT_FALSE(inputs_.hear(step(std::string(kNameBytes + 1, 'x'))));
  EXPECT_THAT(refused_, ElementsAre("step"));
  for (std::size_t n = 0; n < kProducts; ++n) inputs_.hear(product(std::to_string(n)));
  EXPECT_FALSE(inputs_.hear(product("one more")));
  EXPECT_THAT(refused_, ElementsAre("step", "data product"));
  EXPECT_TRUE(inputs_.hear(product("0", 8)));
}

}  // namespace
}  // namespace roci::planner
