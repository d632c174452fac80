// An arm with dynamics of its own in its world: what it asks for, how long it takes, how it fails.
#include "sim_svc/components/dynamic_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/walker.hpp"

namespace roci::sim::components {
namespace {

using temporal::Duration;
using temporal::seconds;
using temporal::State;
using temporal::Time;
using world::ComponentMishap;
using world::JointWear;

// How long the arm takes from s0, where it has grasped m0, to s2.
double carrying_s(double told_kg, double true_kg) {
  Walker walker;
  walker.grapple.modules["m0"].mass_kg = told_kg;
  walker.grapple.modules["m0"].true_mass_kg = true_kg;
  WalkerFlight run(walker);
  run.move("home", "s0");
  EXPECT_EQ(run.done("localize", "s0"), "done");
  EXPECT_EQ(run.done("grasp", "s0", "m0"), "done");
  return run.move("s0", "s2", 4);
}

TEST(DynamicArm, MovesAndRestsAtThePose) {
  WalkerFlight run;
  EXPECT_EQ(run.state("walker.arm"), (State{"idle-pose", {"home"}}));
  const double took = run.move("home", "s0");
  EXPECT_EQ(run.code("move1"), "done");
  EXPECT_GT(took, 6);
  EXPECT_LT(took, 12);
  EXPECT_EQ(run.state("walker.arm"), (State{"idle-pose", {"s0"}}));
  EXPECT_NEAR(last_number(run.said, "walker.arm.q2"), 0.8, 0.006);
  EXPECT_GT(run.last_ack("move1")->status.results.energy_j, 15 * took);
}

TEST(DynamicArm, AsksForAMotionWithTheLoadThatItBelievesToHold) {
  Walker walker;
  walker.grapple.modules["m0"].true_mass_kg = 130;
  WalkerFlight run(walker);
  run.move("home", "s0");
  run.done("localize", "s0");
  run.done("grasp", "s0", "m0");
  run.move("s0", "s2");
  std::vector<double> loads;
  for (const world::Output& output : run.said)
    if (const auto* wanted = std::get_if<world::MotionWanted>(&output)) {
      loads.push_back(wanted->payload_kg);
      if (wanted->payload_kg > 0) {
        EXPECT_EQ(wanted->payload_size_m, (std::vector<double>{0.5, 0.5, 0.5}));
      }
    }
  EXPECT_EQ(loads, (std::vector<double>{0, 80}));
}

TEST(DynamicArm, AModuleHeavierThanToldMakesAMoveSlower) {
  const double as_told = carrying_s(80, 80);
  EXPECT_GT(carrying_s(80, 400), as_told + 0.5);
}

TEST(DynamicArm, AJointThatDegradesMakesMovesSlowerAndFailsAtLast) {
  WalkerFlight run;
  const double before = run.move("home", "s0");
  run.disturb(run.now, ComponentMishap{"walker", JointWear{"elbow", 0.8, 0}});
  run.move("s0", "home");
  EXPECT_GT(run.move("home", "s0"), before + 0.5);
  run.disturb(run.now, ComponentMishap{"walker", JointWear{"elbow", 1.2, 0}});
  run.move("s0", "home");
  EXPECT_EQ(run.code("move4"), "arm-stalled");
  EXPECT_THAT(run.last_ack("move4")->status.reason, testing::HasSubstr("joint 'elbow'"));
  EXPECT_EQ(run.state("walker.arm"), (State{"idle-pose", {"arm-here"}}));
}

TEST(DynamicArm, WearsByUseUntilItStandsStill) {
  Walker walker;
  walker.arm.wear.growth[2] = 25;  // N·m for each rad; the elbow has 80 N·m
  WalkerFlight run(walker);
  run.move("home", "s0");
  int moves = 1;
  for (; moves < 20 && run.code("move" + std::to_string(moves)) == "done"; ++moves)
    run.move(moves % 2 ? "s0" : "home", moves % 2 ? "home" : "s0");
  EXPECT_EQ(run.code("move" + std::to_string(moves)), "arm-stalled");
  EXPECT_GT(moves, 3);
  EXPECT_LT(moves, 12);
}

TEST(DynamicArm, AMishapOnTheWayChangesTheRestOfTheMotion) {
  WalkerFlight slow, free;
  free.move("home", "s0");
  slow.now = seconds(1);
  slow.move_arm(slow.now, "m", "home", "s0", joints_at("s0"), 6);
  slow.disturb(seconds(3), ComponentMishap{"", JointWear{"elbow", 0.85, 0}});
  slow.advance(seconds(100));
  EXPECT_EQ(slow.code("m"), "done");
  EXPECT_GT(slow.time_of("m"), free.time_of("move1") + seconds(0.5));
}

TEST(DynamicArm, SaysWhichJointsItHas) {
  WalkerFlight run;
  const DynamicArm arm(Walker{}.arm, world::RandomStream(1, "arm"));
  EXPECT_EQ(arm.spared_from(world::ModuleFailure{"m0"}), std::nullopt);
  EXPECT_EQ(arm.spared_from(JointWear{"elbow", 1, 0}), "");
  EXPECT_THAT(arm.spared_from(JointWear{"elbwo", 1, 0}).value(),
              testing::AllOf(testing::HasSubstr("known: rail, shoulder, elbow, wrist"),
                             testing::HasSubstr("did you mean 'elbow'?")));
}

// An arm that is spoken for by another process stands where it stood and moves as heavily as before.
TEST(DynamicArm, OutlivesItsProcess) {
  WalkerFlight run;
  run.move("home", "s0");
  run.disturb(run.now, ComponentMishap{"walker", JointWear{"elbow", 0.8, 0}});
  WalkerFlight next, fresh;
  next.world.restore(run.world.memory());
  next.joints = joints_at("s0");
  next.now = run.now;
  next.advance(run.now);
  EXPECT_EQ(next.state("walker.arm"), (State{"idle-pose", {"s0"}}));
  EXPECT_GT(next.move("s0", "home"), fresh.move("home", "s0") + 0.5);
}

enum class Asking { seldom, often };

// A mission of moves with a stop, a mishap on the way, and grapple work.
world::Outputs flown(Asking asking) {
  Walker walker;
  walker.arm.drive.friction_noise = 0.1;
  walker.grapple.duration_noise = 0.05;
  walker.power.orbit = world::Orbit{600, 200, 300, 500, "sun.window"};
  walker.grapple.modules["m0"].latch_tries = 2;
  WalkerFlight run(walker, 7);
  Time asked{};
  const auto go_to = [&](Time until) {
    for (; asking == Asking::often && asked < until; asked += Duration(777777)) run.advance(asked);
    asked = std::max(asked, until);
  };
  const auto at = [&](double s) {
    go_to(seconds(s));
    return std::max(seconds(s), asking == Asking::often ? Time{} : Time{});
  };
  run.move_arm(at(10), "a", "home", "s0", joints_at("s0"), 6);
  run.work(at(60), "b", "localize", "s0");
  run.work(at(150), "c", "grasp", "s0", "m0");
  run.move_arm(at(300), "d", "s0", "s2", joints_at("s2"), 8);
  run.disturb(at(303.3), ComponentMishap{"walker", JointWear{"shoulder", 0.5, 0.01}});
  run.work(at(400), "e", "localize", "s2");
  run.work(at(460), "f", "place", "s2", "m0");
  run.move_arm(at(700), "g", "s2", "s1", joints_at("s1"), 8);
  run.command(at(704.4), execute("h", "arm", "stop"));
  go_to(seconds(900));
  run.advance(seconds(900));
  return run.said;
}

TEST(DynamicArm, WhatHappensDoesNotDependOnHowTimeIsSliced) {
  const world::Outputs once = flown(Asking::seldom), often = flown(Asking::often);
  EXPECT_GT(once.size(), 60u);
  EXPECT_TRUE(once == often);
  EXPECT_EQ(std::get<State>(last_value(once, "walker.module.m0").value()), (State{"latched", {"s2"}}));
}

}  // namespace
}  // namespace roci::sim::components
