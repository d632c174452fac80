#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using services::owner::Action;
using services::owner::Request;
using services::owner::Stage;
using temporal::seconds;
using temporal::State;

namespace {

using testing::HasSubstr;

Request asking(const std::string& activity, Action action, std::uint64_t epoch = 1) {
  return {{activity, 1}, action, epoch};
}

TEST(Commands, AKeyIsTakenOnce) {
  Flight run(flat_setup());
  const Request image = execute("i", "camera", "image", {{"image", "one"}});
  run.command(seconds(1), image);
  run.advance(seconds(60));
  const std::size_t before = run.said.size();
  const std::size_t acks = run.acks.size();
  run.command(seconds(60), image);
  EXPECT_EQ(run.said.size(), before);
  EXPECT_EQ(run.acks.size(), acks + 1);
  EXPECT_EQ(run.world.take_begun().size(), 1u);
  EXPECT_EQ(run.stage("i"), Stage::completed);
  EXPECT_EQ(run.state("rover.camera"), (State{"idle", {}}));
}

TEST(Commands, AnotherAttemptIsAnotherKey) {
  Flight run(flat_setup());
  Request image = execute("i", "camera", "image", {{"image", "one"}});
  run.command(seconds(1), image);
  run.advance(seconds(60));
  image.key.attempt = 2;
  run.command(seconds(60), image);
  EXPECT_EQ(run.state("rover.camera"), (State{"imaging", {}}));
}

TEST(Commands, AQueryGetsTheLastWord) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  run.command(seconds(2), asking("i", Action::query));
  EXPECT_EQ(run.stage("i"), Stage::accepted);
  run.advance(seconds(60));
  run.command(seconds(61), asking("i", Action::query));
  EXPECT_EQ(run.stage("i"), Stage::completed);
  EXPECT_EQ(run.time_of("i"), seconds(61));
  run.command(seconds(62), asking("never", Action::query));
  EXPECT_EQ(run.stage("never"), Stage::unknown);
  EXPECT_EQ(run.code("never"), "unknown-key");
}

TEST(Commands, AnOlderEpochIsRefused) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("new", "camera", "image", {{"image", "one"}}, 5));
  run.command(seconds(60), execute("old", "camera", "image", {{"image", "two"}}, 4));
  EXPECT_EQ(run.stage("old"), Stage::rejected);
  EXPECT_EQ(run.code("old"), "old-epoch");
  run.command(seconds(61), execute("newer", "camera", "image", {{"image", "three"}}, 6));
  EXPECT_EQ(run.stage("newer"), Stage::accepted);
  run.command(seconds(62), asking("newer", Action::cancel, 5));
  EXPECT_EQ(run.state("rover.camera"), (State{"imaging", {}}));
}

// What a component does to the world is told whatever let the command through.
TEST(Commands, EveryEffectIsToldWithWhatCausedIt) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}, 5));
  EXPECT_TRUE(run.world.take_effects().empty()) << "the shutter has not closed yet";
  run.advance(seconds(60));
  const auto effects = run.world.take_effects();
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].effect.kind, "image");
  EXPECT_EQ(effects[0].effect.object, "one");
  EXPECT_EQ(effects[0].component, "camera");
  EXPECT_EQ(effects[0].cause.activity, "i");
  // Past the owner's rules the same key is done again, and that is seen.
  run.world.begin(seconds(61), {"", "camera", {effects[0].cause, "image", {{"image", "one"}}}});
  run.world.advance(seconds(120));
  EXPECT_EQ(run.world.take_effects().size(), 1u);
}

TEST(Commands, ARefusedEpochDoesNotTakeTheKey) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("x", "arm", "unknown", {}, 5));
  run.command(seconds(2), execute("i", "camera", "image", {{"image", "one"}}, 4));
  EXPECT_EQ(run.stage("i"), Stage::rejected);
  run.command(seconds(3), execute("i", "camera", "image", {{"image", "one"}}, 5));
  EXPECT_EQ(run.stage("i"), Stage::accepted);
}

TEST(Commands, UnknownComponentsAndCommandsAreRefusedByNamingTheKnown) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("a", "wheels", "drive"));
  EXPECT_EQ(run.stage("a"), Stage::rejected);
  EXPECT_THAT(run.last_ack("a")->status.reason, HasSubstr("nav, arm, camera, gripper, radio"));
  run.command(seconds(2), execute("b", "nav", "fly"));
  EXPECT_EQ(run.stage("b"), Stage::rejected);
  EXPECT_THAT(run.last_ack("b")->status.reason, HasSubstr("drive, turn, stop"));
  run.command(seconds(3), execute("c", "nav", "drive", {{"to", "there"}}));
  EXPECT_EQ(run.stage("c"), Stage::rejected);
  EXPECT_THAT(run.last_ack("c")->status.reason, HasSubstr("'x'"));
  run.command(seconds(4), execute("d", "nav", "drive", {{"to", "there"}, {"x", "far"}, {"y", "1"}}));
  EXPECT_EQ(run.code("d"), "bad-arguments");
}

TEST(Commands, ABusyComponentRefusesASecondTask) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  run.command(seconds(2), execute("j", "camera", "image", {{"image", "two"}}));
  EXPECT_EQ(run.stage("j"), Stage::rejected);
  EXPECT_EQ(run.code("j"), "busy");
  run.advance(seconds(60));
  EXPECT_EQ(run.stage("i"), Stage::completed);
}

TEST(Commands, ACancelEndsWhatRuns) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  run.command(seconds(10), asking("i", Action::cancel));
  EXPECT_EQ(run.stage("i"), Stage::cancelled);
  run.advance(seconds(100));
  EXPECT_FALSE(last_value(run.said, "rover.image.one").has_value());
}

TEST(Commands, ACancelThatComesTooLateFailsAndLeavesTheLastWord) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  run.advance(seconds(100));
  run.command(seconds(100), asking("i", Action::cancel));
  EXPECT_EQ(run.stage("i"), Stage::cancel_failed);
  run.command(seconds(101), asking("i", Action::query));
  EXPECT_EQ(run.stage("i"), Stage::completed);
  run.command(seconds(102), asking("never", Action::cancel));
  EXPECT_EQ(run.stage("never"), Stage::unknown);
}

}  // namespace
}  // namespace roci::sim::world
