// What roci prints: lines for people, and JSON that parses whatever came down.
#include "ground_console/cli/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ground_console/cli/verbs.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Json, OfTheStatusHasEveryPart) {
  lib::MissionView view = flying_mission();
  v1::Heartbeat beat;
  beat.service("arm_svc");
  beat.state(v1::SERVICE_RUNNING);
  view.take(beat);
  const json status = json::parse(cli::json_text(cli::status_json(view)));
  EXPECT_EQ(status["mission"], "planetary");
  EXPECT_EQ(status["phase"], "executing");
  EXPECT_EQ(status["time_s"], 300);
  EXPECT_EQ(status["replans"], 1);
  ASSERT_EQ(status["goals"].size(), 2U);
  EXPECT_EQ(status["goals"][0]["id"], "far");
  EXPECT_EQ(status["goals"][0]["state"], "rejected");
  EXPECT_EQ(status["goals"][1]["class"], "hard");
  EXPECT_EQ(status["services"][0]["state"], "running");
  EXPECT_EQ(status["timelines"]["rover.nav"], "idle-at");
}

// R129: idle after the plan until the next one.
TEST(Json, OfTheStatusTellsSinceWhenAndAfterWhichPlanTheRobotIdles) {
  lib::MissionView view = flying_mission();
  v1::ExecutedPlan executed;
  executed.executive(view.executive());
  executed.version(view.mission()->plan_version());
  executed.header().stamp_us(290'000'000);
  executed.outcome(v1::EXECUTED_BROKEN);
  executed.reason("a drive failed");
  view.take(executed);
  EXPECT_FALSE(cli::status_json(view).contains("idle")) << "a plan is executed";
  v1::MissionStatus status = *view.mission();
  status.header().seq(status.header().seq() + 1);
  status.phase(v1::PHASE_SAFE);
  view.take(status);
  EXPECT_EQ(
      cli::status_json(view)["idle"],
      (json{{"since_s", 290.0}, {"after_plan", 2}, {"outcome", "broken"}, {"reason", "a drive failed"}}));
  EXPECT_THAT(cli::status_text(view), HasSubstr("idle since 00:04:50: plan 2 broken, a drive failed\n"));
  status.header().seq(status.header().seq() + 1);
  status.plan_version(3);
  view.take(status);
  EXPECT_FALSE(cli::status_json(view).contains("idle")) << "of the newest plan nothing is known";
}

TEST(Json, OfThePlanHasItsActivitiesAndTheirStates) {
  const json plan = json::parse(cli::json_text(cli::plan_json(flying_mission())));
  EXPECT_EQ(plan["version"], 2);
  ASSERT_EQ(plan["activities"].size(), 2U);
  EXPECT_EQ(plan["activities"][0]["state"], "succeeded");
  EXPECT_EQ(plan["activities"][0]["ended_us"], 290'000'000);
  EXPECT_EQ(plan["activities"][1]["ended_us"], -1);
  EXPECT_EQ(cli::json_text(cli::plan_json(lib::MissionView())), "null");
}

TEST(Json, ParsesWhateverBytesCameDown) {
  const v1::GoalStatus status = goal_status("\xff", v1::GOAL_REJECTED, 1, "unknown kind '\xc3\x28\"\n'");
  EXPECT_EQ(json::parse(cli::json_text(cli::to_json(status)))["state"], "rejected");
  EXPECT_EQ(json::parse(cli::json_text(cli::to_json(event("\xff", 1))))["severity"], "info");
  EXPECT_THAT(cli::json_text(cli::to_json(status)), Not(HasSubstr("\n")));
}

// The words of the mission come first, those of the planner are there for who asks why.
TEST(Lines, OfAGoalThatWasGivenUpHaveTheMissionsWordsAlone) {
  const v1::GoalStatus status =
      goal_status("far", v1::GOAL_DROPPED, 1, "out of reach: steep\ndetails: no sequence of actions");
  EXPECT_THAT(cli::goal_line(status), HasSubstr("out of reach: steep (journaled)"));
  EXPECT_EQ(cli::to_json(status)["reason"], "out of reach: steep");
  EXPECT_EQ(cli::to_json(status)["details"], "no sequence of actions");
}

// Scripts see by the exit code that a change was refused, whatever becomes of the goal as it was.
TEST(Goals, AChangeThatWasRefusedCountsAsRefused) {
  EXPECT_TRUE(cli::is_refused(goal_status("a", v1::GOAL_REJECTED, 1, "unknown kind")));
  EXPECT_TRUE(cli::is_refused(goal_status("a", v1::GOAL_PLANNED, 1, "change refused: it is a photo")));
  EXPECT_TRUE(cli::is_refused(goal_status("a", v1::GOAL_DROPPED, 1, "change refused: argument 'x' is 'y'")));
  EXPECT_FALSE(cli::is_refused(goal_status("a", v1::GOAL_PENDING, 1, "changed by ground")));
  EXPECT_FALSE(cli::is_refused(goal_status("a", v1::GOAL_DROPPED, 1, "out of reach")));
}

TEST(Goals, AnArgumentThatIsGivenTwiceIsRefused) {
  cli::GoalArguments photo;
  photo.arguments = {"x=110", "y=60"};
  EXPECT_EQ(cli::goal_of(photo).arguments().size(), 2U);
  photo.arguments.push_back("x=3");
  EXPECT_THAT([&] { cli::goal_of(photo); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  "argument 'x' is given twice, as '110' and as '3'; leave one out"));
}

TEST(Lines, NameWhatMatters) {
  EXPECT_THAT(cli::goal_line(goal_status("far", v1::GOAL_REJECTED, 1, "outside the map")),
              ::testing::ContainsRegex("ground/far +photo +hard +rejected +outside the map"));
  EXPECT_EQ(cli::event_line(event("plan 1 is broken", 90, v1::SEVERITY_WARNING)),
            "00:01:30  exec_svc     warning: plan 1 is broken");
  EXPECT_THAT(cli::status_text(flying_mission()),
              HasSubstr("planetary  00:05:00  executing, plan 2, 1 replans"));
}

}  // namespace
}  // namespace roci::console
