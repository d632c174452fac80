// The structure in orbit: what is, what is known of it, and what the grapple can do.
#include "sim_svc/components/grapple.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/walker.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using world::ComponentMishap;

TEST(Grapple, TellsOfTheStructureAtTheStart) {
  WalkerFlight run;
  EXPECT_EQ(run.state("walker.grapple"), (State{"empty", {}}));
  EXPECT_EQ(run.state("walker.fix"), (State{"none", {}}));
  EXPECT_EQ(run.state("walker.module.m1"), (State{"latched", {"s1"}}));
  EXPECT_EQ(run.state("walker.health.m1"), (State{"works", {}}));
  EXPECT_EQ(run.state("walker.slot.s1"), (State{"taken", {"m1"}}));
  EXPECT_EQ(run.state("walker.slot.s2"), (State{"free", {}}));
}

TEST(Grapple, BringsAModuleFromSlotToSlot) {
  WalkerFlight run;
  run.move("home", "s0");
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "no-fix");
  EXPECT_EQ(run.done("localize", "s0"), "done");
  EXPECT_EQ(run.state("walker.fix"), (State{"on", {"s0"}}));
  EXPECT_EQ(run.done("place", "s0", "m0"), "not-held");
  EXPECT_EQ(run.done("grasp", "s0", "m1"), "no-module");
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "done");
  EXPECT_EQ(run.state("walker.grapple"), (State{"holding", {"m0"}}));
  EXPECT_EQ(run.state("walker.module.m0"), (State{"held", {}}));
  EXPECT_EQ(run.state("walker.slot.s0"), (State{"free", {}}));
  run.move("s0", "s1");
  EXPECT_EQ(run.state("walker.fix"), (State{"none", {}}));
  EXPECT_EQ(run.done("place", "s1", "m0"), "no-fix");
  EXPECT_EQ(run.done("localize", "s1"), "done");
  EXPECT_EQ(run.done("place", "s1", "m0"), "slot-taken");
  EXPECT_EQ(run.done("grasp", "s1", "m1"), "not-empty");
  run.move("s1", "s2");
  EXPECT_EQ(run.done("localize", "s2"), "done");
  EXPECT_EQ(run.done("place", "s2", "m0"), "done");
  EXPECT_EQ(run.state("walker.grapple"), (State{"empty", {}}));
  EXPECT_EQ(run.state("walker.module.m0"), (State{"latched", {"s2"}}));
  EXPECT_EQ(run.state("walker.slot.s2"), (State{"taken", {"m0"}}));
}

TEST(Grapple, AFixIsLostWhenTheArmHasMovedThoughItCameBack) {
  WalkerFlight run;
  run.move("home", "s0");
  run.done("localize", "s0");
  run.move("s0", "s2");
  run.move("s2", "s0");
  EXPECT_EQ(run.state("walker.fix"), (State{"none", {}}));
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "no-fix");
}

TEST(Grapple, WorksWhereTheArmRestsAloneAndHoldsItStill) {
  WalkerFlight run;
  EXPECT_EQ(run.done("localize", "s0"), "wrong-pose");
  EXPECT_EQ(run.done("localize", "s9"), "unknown-slot");
  run.move("home", "s0");
  run.done("localize", "s0");
  EXPECT_EQ(run.done("grasp", "s0", "m7"), "unknown-module");
  run.work(run.now + seconds(1), "g", "grasp", "s0", "m0");
  run.move_arm(run.now + seconds(2), "a", "s0", "s1", joints_at("s1"), 6);
  EXPECT_EQ(run.code("a"), "grapple-busy");
}

// Place takes 60 s, and the second try of the latch 30 s.
TEST(Grapple, ALatchThatNeedsASecondTryRepairsItselfInTime) {
  Walker walker;
  walker.grapple.modules["m0"].latch_tries = 2;
  WalkerFlight run(walker);
  run.move("home", "s0");
  run.done("localize", "s0");
  run.done("grasp", "s0", "m0");
  run.now += seconds(1);
  const double begun = temporal::to_seconds(run.now);
  run.work(run.now, "p", "place", "s0", "m0", begun + 95);
  run.advance(seconds(begun + 61));
  EXPECT_EQ(run.stage("p"), Stage::accepted);
  EXPECT_EQ(run.code("p"), "repairing");
  EXPECT_THAT(run.last_ack("p")->status.reason, testing::HasSubstr("the latch of 's0' did not close"));
  EXPECT_EQ(run.state("walker.grapple"), (State{"working", {}}));
  run.advance(seconds(begun + 200));
  EXPECT_EQ(run.code("p"), "done");
  EXPECT_EQ(run.time_of("p"), seconds(begun + 90));
  EXPECT_EQ(std::get<double>(run.last_ack("p")->status.results.values.at("tries")), 2);
}

TEST(Grapple, ALatchThatCannotCloseInTimeFailsAndTheModuleRests) {
  Walker walker;
  walker.grapple.modules["m0"].latch_tries = 2;
  WalkerFlight run(walker);
  run.move("home", "s0");
  run.done("localize", "s0");
  run.done("grasp", "s0", "m0");
  const double begun = temporal::to_seconds(run.now);
  run.work(run.now, "p", "place", "s0", "m0", begun + 85);
  run.advance(seconds(begun + 200));
  EXPECT_EQ(run.stage("p"), Stage::failed);
  EXPECT_EQ(run.code("p"), "latch-failed");
  EXPECT_EQ(run.time_of("p"), seconds(begun + 60));
  EXPECT_EQ(run.state("walker.module.m0"), (State{"resting", {"s0"}}));
  EXPECT_EQ(run.state("walker.grapple"), (State{"empty", {}}));
  run.now = seconds(begun + 200);
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "done");
  EXPECT_EQ(run.done("place", "s0", "m0"), "done");
  EXPECT_EQ(run.state("walker.module.m0"), (State{"latched", {"s0"}}));
}

TEST(Grapple, ABlockedSlotLooksFreeUntilItIsLocalized) {
  Walker walker;
  walker.grapple.slots["s2"].blocked = true;
  WalkerFlight run(walker);
  EXPECT_EQ(run.state("walker.slot.s2"), (State{"free", {}}));
  run.move("home", "s2");
  EXPECT_EQ(run.done("localize", "s2"), "slot-blocked");
  EXPECT_EQ(run.state("walker.slot.s2"), (State{"blocked", {}}));
  EXPECT_EQ(run.state("walker.fix"), (State{"none", {}}));
}

TEST(Grapple, ASlotMayBecomeBlockedBeforeTheModuleIsIn) {
  WalkerFlight run;
  run.move("home", "s0");
  run.done("localize", "s0");
  run.done("grasp", "s0", "m0");
  run.disturb(run.now, ComponentMishap{"", world::SlotBlock{"s0"}});
  EXPECT_EQ(run.state("walker.slot.s0"), (State{"free", {}}));
  EXPECT_EQ(run.done("place", "s0", "m0"), "slot-blocked");
  EXPECT_EQ(run.state("walker.slot.s0"), (State{"blocked", {}}));
  EXPECT_EQ(run.state("walker.grapple"), (State{"holding", {"m0"}}));
}

TEST(Grapple, LocalizesInTheLightAlone) {
  Walker walker;
  walker.grapple.light = "sun.window";
  WalkerFlight run(walker);
  run.move("home", "s0");
  run.work(seconds(990), "late", "localize", "s0");
  run.advance(seconds(1100));
  EXPECT_EQ(run.code("late"), "too-dark");
  EXPECT_EQ(run.time_of("late"), seconds(1000));
  run.now = seconds(1500);
  EXPECT_EQ(run.done("localize", "s0"), "too-dark");
  run.now = seconds(2000);
  EXPECT_EQ(run.done("localize", "s0"), "done");
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "done");
}

TEST(Grapple, AModuleThatFailsIsDamagedFromThenOn) {
  WalkerFlight run;
  run.disturb(seconds(50), ComponentMishap{"walker", world::ModuleFailure{"m1"}});
  EXPECT_EQ(run.state("walker.health.m1"), (State{"damaged", {}}));
  EXPECT_EQ(run.state("walker.health.m0"), (State{"works", {}}));
}

TEST(Grapple, IsAsBeforeWhenItIsStopped) {
  WalkerFlight run;
  run.move("home", "s0");
  run.done("localize", "s0");
  run.work(run.now, "g", "grasp", "s0", "m0");
  run.command(run.now + seconds(30), execute("stop", "grapple", "stop"));
  EXPECT_EQ(run.stage("g"), Stage::cancelled);
  EXPECT_EQ(run.state("walker.grapple"), (State{"empty", {}}));
  EXPECT_EQ(run.state("walker.module.m0"), (State{"latched", {"s0"}}));
}

TEST(Grapple, OutlivesItsProcess) {
  Walker walker;
  walker.grapple.slots["s3"].blocked = true;
  walker.grapple.modules["m0"].latch_tries = 2;
  WalkerFlight run(walker);
  run.move("home", "s3");
  run.done("localize", "s3");
  run.move("s3", "s0");
  run.done("localize", "s0");
  run.done("grasp", "s0", "m0");
  run.disturb(run.now, ComponentMishap{"", world::ModuleFailure{"m1"}});
  WalkerFlight next;
  next.world.restore(run.world.memory());
  next.advance(next.now = run.now);
  EXPECT_EQ(next.state("walker.grapple"), (State{"holding", {"m0"}}));
  EXPECT_EQ(next.state("walker.module.m0"), (State{"held", {}}));
  EXPECT_EQ(next.state("walker.health.m1"), (State{"damaged", {}}));
  EXPECT_EQ(next.state("walker.slot.s3"), (State{"blocked", {}}));
  EXPECT_EQ(next.state("walker.slot.s0"), (State{"free", {}}));
  EXPECT_EQ(next.done("place", "s0", "m0"), "no-fix");
  EXPECT_EQ(next.done("localize", "s0"), "done");
  next.work(next.now, "p", "place", "s0", "m0");
  next.advance(next.now + seconds(200));
  EXPECT_EQ(std::get<double>(next.last_ack("p")->status.results.values.at("tries")), 2);
}

}  // namespace
}  // namespace roci::sim::components
