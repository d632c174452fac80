// What the tool carries has mass and takes room; modules stand in the way of all who do not come for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm_svc/inverse_dynamics.hpp"
#include "arm_svc/motion.hpp"
#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;
using testing::HasSubstr;

const Payload kModule{80, {0.4, 0.4, 0.4}};

TEST(Payload, IsHeldInTheMiddleOfAFace) {
  EXPECT_EQ(held_centre({0.4, 0.2, 0.6}, Eigen::Vector3d::UnitX()), Eigen::Vector3d(0.2, 0, 0));
  EXPECT_EQ(held_centre({0.4, 0.2, 0.6}, -Eigen::Vector3d::UnitZ()), Eigen::Vector3d(0, 0, -0.3));
  EXPECT_EQ(held_centre({0, 0, 0}, Eigen::Vector3d::UnitZ()), Eigen::Vector3d(0, 0, 0)) << "a point";
  const ArmSetup setup = test::rail_setup();
  const Arm arm = loaded(setup.arm, {80, {0.4, 0.2, 0.6}}, setup.tool_axis);
  const auto& shape = arm.bodies.back().shapes.back();
  EXPECT_EQ(shape.link, "load");
  EXPECT_LT((shape.pose.translation() - setup.arm.tool * Eigen::Vector3d(0.2, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(arm.bodies.back().mass.mass, setup.arm.bodies.back().mass.mass + 80, 1e-12);
}

// A load at rest pulls with its weight at its centre; one that turns resists by its moment of inertia.
TEST(Payload, PullsAndResistsAsABoxDoes) {
  const ArmSetup setup = test::rail_setup();
  const JointVector rest = JointVector::Zero(7);
  const Payload load{10, {0.4, 0.2, 0.6}};
  const Arm arm = loaded(setup.arm, load, setup.tool_axis);
  const Eigen::Vector3d gravity(0, 0, -3);
  JointState state{rest, rest, rest};
  const JointVector still = joint_efforts(arm, state, gravity) - joint_efforts(setup.arm, state, gravity);
  const double lever = 0.7 + 0.6 + 0.2 + 0.2;  // from the shoulder to the middle of the box
  EXPECT_NEAR(still[2], -10 * 3 * lever, 1e-9);
  state.acceleration[6] = 2;
  const JointVector turning =
      joint_efforts(arm, state, {0, 0, 0}) - joint_efforts(setup.arm, state, {0, 0, 0});
  EXPECT_NEAR(turning[6], 10.0 / 12 * (0.2 * 0.2 + 0.6 * 0.6) * 2, 1e-9);
}

TEST(Payload, FaultsAreNamed) {
  EXPECT_EQ(fault_of({}), "");
  EXPECT_EQ(fault_of(kModule), "");
  EXPECT_THAT(fault_of({-1, {0, 0, 0}}), HasSubstr("mass"));
  EXPECT_THAT(fault_of({std::nan(""), {0, 0, 0}}), HasSubstr("mass"));
  EXPECT_THAT(fault_of({1, {0.1, 0, 0.1}}), HasSubstr("size"));
  EXPECT_THAT(fault_of({1, {0.1, std::nan(""), 0.1}}), HasSubstr("size"));
  const MotionModel model(test::rail_setup());
  EXPECT_EQ(model.plan({{"home"}, {"s0"}, {-1, {0, 0, 0}}}).status, MotionStatus::faulty);
}

TEST(Load, CostsEnergyAndTime) {
  const MotionModel model(test::rail_setup());
  const Motion empty = model.plan({{"home"}, {"s0"}}), carrying = model.plan({{"home"}, {"s0"}, kModule});
  const Motion heavy = model.plan({{"home"}, {"s0"}, {2000, {0.4, 0.4, 0.4}}});
  ASSERT_EQ(empty.status, MotionStatus::found) << empty.detail;
  ASSERT_EQ(carrying.status, MotionStatus::found) << carrying.detail;
  ASSERT_EQ(heavy.status, MotionStatus::found) << heavy.detail;
  EXPECT_GT(carrying.energy_j, 1.2 * empty.energy_j);
  EXPECT_GT(heavy.duration_s, carrying.duration_s) << "the motors are not strong enough for full speed";
}

// Whoever stands at a pose by joint values is told for sure that the arm cannot hold the load there.
TEST(Load, BeyondWhatTheArmCanHoldIsProvedWhereTheJointsAreGiven) {
  const MotionModel model(test::rover_setup());
  const JointVector stretched = JointVector::Zero(5);
  const Motion motion = model.plan({{"here", stretched}, {"image"}, {60, {0, 0, 0}}});
  EXPECT_EQ(motion.status, MotionStatus::overloaded);
  EXPECT_TRUE(motion.proved);
  EXPECT_THAT(motion.detail, HasSubstr("joint 'shoulder' would need"));
  const MotionBound bound =
      model.bound(model.resolve({"here", stretched}), model.resolve({"image"}), {60, {0, 0, 0}});
  EXPECT_EQ(bound.status, MotionStatus::overloaded);
  EXPECT_TRUE(bound.proved);
}

// A gear that holds takes its friction off what the motor must bear, at rest and on the way down.
TEST(Load, WhatFrictionHoldsIsNotProvedTooHeavy) {
  constexpr double kFriction = 30;
  ArmSetup setup = test::rover_setup();
  for (kinematics::Joint& joint : setup.arm.joints) joint.limits.effort = 1000;
  kinematics::Joint& shoulder = setup.arm.joints[1];
  shoulder.limits.effort = 45;
  shoulder.friction = kFriction;
  const MotionModel model(setup);
  const JointVector rest = JointVector::Zero(5);
  const ResolvedPlace stretched = model.resolve({"here", rest});
  const ResolvedPlace lower = model.resolve({"lower", test::coordinates({0, 0.1, 0, 0, 0})});
  std::vector<double> held;
  int proved = 0;
  for (double mass = 1; mass < 40; mass += 1) {
    const Payload load{mass, {0, 0, 0}};
    const Arm arm = loaded(setup.arm, load, setup.tool_axis);
    const double torque = std::abs(joint_efforts(arm, {rest, rest, rest}, setup.motor.gravity)[1]);
    const MotionBound bound = model.bound(stretched, lower, load);
    EXPECT_EQ(bound.proved, torque - kFriction > 45) << mass;
    EXPECT_EQ(bound.status, bound.proved ? MotionStatus::overloaded : MotionStatus::found) << mass;
    if (bound.proved) {
      ++proved;
    } else if (torque > 45) {
      held.push_back(mass);
    }
  }
  ASSERT_GT(held.size(), 3U);
  EXPECT_GT(proved, 3);
  const Payload load{held.front(), {0, 0, 0}};
  const Motion down = model.plan(stretched, lower, load, 1, {}),
               up = model.plan(lower, stretched, load, 1, {});
  EXPECT_EQ(down.status, MotionStatus::found) << down.detail;
  EXPECT_EQ(up.status, MotionStatus::overloaded) << up.detail;
  EXPECT_FALSE(up.proved) << "another way may exist";
}

TEST(Load, TakesRoom) {
  const ArmSetup setup = test::rail_setup();
  const CollisionChecker empty(setup.arm, setup.collision);
  const CollisionChecker carrying(loaded(setup.arm, kModule, setup.tool_axis), setup.collision);
  JointVector low = JointVector::Zero(7);
  low << 1.5, 0, -0.2, 0.5, 0, 0, 0;  // the tool 0.3 m above the platform
  EXPECT_FALSE(empty.contact(low));
  const auto contact = carrying.contact(low);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->first, "load");
  EXPECT_EQ(contact->second, "platform");
}

TEST(Modules, StandSquareBelowTheToolAndLeaveTheirOwnPoseFree) {
  const ArmSetup setup = test::rail_setup();
  const Places places(std::make_shared<const ArmSetup>(setup));
  ASSERT_EQ(places.modules().size(), 3U);
  EXPECT_LT((places.modules()[0].shape.pose.translation() - Eigen::Vector3d(0.5, 0.9, 0.3)).norm(), 1e-12);
  for (const ResolvedPlace& pose : places.poses()) {
    ASSERT_EQ(pose.status, MotionStatus::found) << pose.detail;
    if (pose.name == "home") continue;
    const Eigen::Matrix3d turn = kinematics::tool_pose(setup.arm, pose.joints).linear();
    for (Eigen::Index i = 0; i < 3; ++i) EXPECT_GT(turn.col(i).cwiseAbs().maxCoeff(), 1 - 1e-6) << pose.name;
  }
}

// The straight way from slot to slot leads through what stands between them.
TEST(Modules, AreGoneAround) {
  ArmSetup setup = test::rail_setup();
  const JointVector before = MotionModel(setup).resolve({"s0"}).joints;
  const JointVector after = MotionModel(setup).resolve({"s1"}).joints;
  ArmSetup bare = setup;
  for (NamedPose& pose : bare.poses) pose.module_size.reset();
  const Eigen::Vector3d between = kinematics::tool_pose(setup.arm, 0.5 * (before + after)).translation();
  NamedPose wall{
      "wall",
      ToolTarget{between + Eigen::Vector3d(0, 0, 0.3), {}, Eigen::Quaterniond(0.7071068, 0, 0.7071068, 0)}};
  wall.module_size = Eigen::Vector3d(0.1, 0.1, 0.6);
  setup.poses.push_back(wall);
  const MotionModel walled(setup);
  const Motion around = walled.motion({"s0"}, {"s1"});
  ASSERT_EQ(around.status, MotionStatus::found) << around.detail;
  EXPECT_GT(around.trajectory.segments.size(), 1U);
  EXPECT_NE(walled.version(), MotionModel(bare).version());
  // Every place on the way is free of the module that stands there.
  std::vector<kinematics::CollisionShape> still{
      Places(std::make_shared<const ArmSetup>(setup)).modules().back().shape};
  const CollisionChecker checker(setup.arm, with_close_margin(setup.collision), still);
  for (const TrajectorySample& sample : sampled(around.trajectory, 0.05)) {
    EXPECT_TRUE(checker.obstacles_touched(sample.position).empty());
  }
}

TEST(Modules, WhereTheArmStandsThereIsNone) {
  const ArmSetup setup = test::rail_setup();
  const MotionModel model(setup);
  JointVector inside = model.resolve({"s0"}).joints;
  const Motion away = model.motion({"arm-here", inside}, {"home"});
  EXPECT_EQ(away.status, MotionStatus::found) << away.detail;
}

}  // namespace
}  // namespace roci::arm
