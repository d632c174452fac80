#include "services/transport/scope.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "services/topics/topics.hpp"

namespace roci::services::transport {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Partitions, FollowFromScopeAndRobot) {
  EXPECT_THAT(partitions_of(Scope::everyone, "rover"), IsEmpty());
  EXPECT_THAT(partitions_of(Scope::team, "rover"), ElementsAre("roci.team"));
  EXPECT_THAT(partitions_of(Scope::team, ""), ElementsAre("roci.team"));
  EXPECT_THAT(partitions_of(Scope::robot, "rover-2_a.b"), ElementsAre("roci.inner.rover-2_a.b"));
  EXPECT_THAT(partitions_of(Scope::robot, ""), ElementsAre("roci.inner", "roci.inner.*"));
}

TEST(Partitions, ARobotCannotBeAPattern) {
  for (const char* robot : {"*", "ro?er", "[ab]", "rover 2", "a@b"})
    EXPECT_THROW(partitions_of(Scope::robot, robot), std::invalid_argument) << robot;
}

// The clock, health and events are everyone's: without them nobody takes part in a run.
TEST(Partitions, TheTopicTableKeepsClockHealthAndEventsForEveryone) {
  EXPECT_EQ(topics::clock_step.scope, Scope::everyone);
  EXPECT_EQ(topics::clock_ready.scope, Scope::everyone);
  EXPECT_EQ(topics::clock_done.scope, Scope::everyone);
  EXPECT_EQ(topics::heartbeat.scope, Scope::everyone);
  EXPECT_EQ(topics::time_probe.scope, Scope::everyone);
  EXPECT_EQ(topics::event.scope, Scope::everyone);
  EXPECT_EQ(topics::goal.scope, Scope::team);
  EXPECT_EQ(topics::hazard.scope, Scope::team);
  EXPECT_EQ(topics::map_patch.scope, Scope::team);
  EXPECT_EQ(topics::terrain_finding.scope, Scope::robot);
  EXPECT_EQ(topics::known_map.scope, Scope::robot);
  EXPECT_EQ(topics::command.scope, Scope::robot);
  EXPECT_EQ(topics::call_cancel.scope, topics::plan_request.request.scope);
}

}  // namespace
}  // namespace roci::services::transport
