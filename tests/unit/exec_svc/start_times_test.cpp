// Times that starts get before a plan is executed: fixed ones at E2, latest ones where the mission asks for them.
#include "exec_svc/reactor/start_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

// A drive of 10 to 60 s, then a picture of 5 to 20 s; all is over within the horizon.
PlanBuilder drive_and_picture(double horizon) {
  PlanBuilder b;
  b.activity("drive", "sim", 10, 60);
  b.activity("picture", "sim", 5, 20);
  b.after("drive", "picture", 1);
  b.window(b.end("picture"), 0, horizon);
  return b;
}

TEST(FixedStarts, LeaveRoomForTheLongestAndAreKeptWhateverEndsSooner) {
  PlanBuilder b = drive_and_picture(200);
  reactor::fix_starts(b.plan);
  ScriptedWorld quick(b.plan);
  quick.answers("drive", {{.lasts = 12}});
  EXPECT_THAT(quick.run(), IsSupersetOf({"0 execute drive#1", "61 execute picture#1"}));
  ScriptedWorld slow(b.plan);
  slow.answers("drive", {{.lasts = 60}});
  EXPECT_THAT(slow.run(), Contains("61 execute picture#1")) << "the end just comes in time";
  ScriptedWorld late(b.plan);
  late.answers("drive", {{.lasts = 62}});
  EXPECT_THAT(late.run(), Contains(HasSubstr("late_start, picture")));
}

TEST(FixedStarts, AreTheEarliestWhereThereIsNoRoomForTheLongest) {
  PlanBuilder b = drive_and_picture(40);
  reactor::fix_starts(b.plan);
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 10}});
  EXPECT_THAT(world.run(), Contains("11 execute picture#1"));
  ScriptedWorld late(b.plan);
  late.answers("drive", {{.lasts = 12}});
  EXPECT_THAT(late.run(), Contains(HasSubstr("late_start, picture")));
}

TEST(FixedStarts, NothingIsPushedAndWhatIsTiedToAnEndGoesWithIt) {
  PlanBuilder b = drive_and_picture(200);
  b.activity("wipe", "sim", 5);
  b.between(b.end("drive"), b.start("wipe"), 0, 0);
  b.plan.activities[1].lateness = temporal::LatenessPolicy::push;
  b.plan.activities[1].wait_timeout = temporal::seconds(1000);
  reactor::fix_starts(b.plan);
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 30}});
  EXPECT_THAT(world.run(), IsSupersetOf({"30 execute wipe#1", "61 execute picture#1"}));
  EXPECT_EQ(b.plan.activities[1].lateness, temporal::LatenessPolicy::replan);
}

TEST(LatestStarts, LeaveRoomForTheLongest) {
  PlanBuilder b = drive_and_picture(200);
  reactor::prefer_latest_starts(b.plan);
  const executive::ExecutiveSettings latest{.start = executive::StartPolicy::latest};
  ScriptedWorld slow(b.plan, latest);
  slow.answers("drive", {{.lasts = 60}});
  slow.answers("picture", {{.lasts = 20}});
  EXPECT_THAT(slow.run(),
              IsSupersetOf({"119 execute drive#1", "180 execute picture#1", "200 plan finished"}));
  ScriptedWorld quick(b.plan, latest);
  quick.answers("drive", {{.lasts = 10}});
  EXPECT_THAT(quick.run(), Contains("180 execute picture#1")) << "it, too, starts as late as it may";
}

TEST(LatestStarts, AreThoseOfTheWindowsWhereThereIsNoRoom) {
  PlanBuilder b = drive_and_picture(40);
  reactor::prefer_latest_starts(b.plan);
  ScriptedWorld world(b.plan, {.start = executive::StartPolicy::latest});
  world.answers("drive", {{.lasts = 10}});
  EXPECT_THAT(world.run(), IsSupersetOf({"24 execute drive#1", "35 execute picture#1"}));
}

}  // namespace
}  // namespace roci::exec::testing
