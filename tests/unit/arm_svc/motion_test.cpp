#include "arm_svc/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;
using test::coordinates;
using testing::HasSubstr;

// The rover arm with `count` random free poses beside its own: many pairs have deck, mast or ground between
// them.
ArmSetup crowded_setup(int count) {
  ArmSetup setup = test::rover_setup();
  const CollisionChecker checker(setup.arm, setup.collision);
  std::mt19937_64 rng(20);
  for (int i = 0; i < count;) {
    const JointVector q = sample_coordinates(setup.arm, rng);
    if (checker.contact(q)) continue;
    setup.poses.push_back({"random" + std::to_string(i++), q});
  }
  return setup;
}

std::string key_of(const Motion& motion) {
  std::ostringstream key;
  key << std::hexfloat << name_of(motion.status) << ' ' << motion.duration_s << ' ' << motion.energy_j;
  for (const auto& sample : sampled(motion.trajectory, 0.5)) key << '\n' << sample.position.transpose();
  return key.str();
}

TEST(Motion, ConnectsAllPosesOfThePlanetaryMission) {
  const MotionModel model(test::rover_setup());
  for (const ResolvedPlace& from : model.poses()) {
    EXPECT_EQ(from.status, MotionStatus::found) << from.detail;
    for (const ResolvedPlace& to : model.poses()) {
      const Motion motion = model.motion({from.name}, {to.name});
      ASSERT_EQ(motion.status, MotionStatus::found)
          << from.name << " to " << to.name << ": " << motion.detail;
      EXPECT_EQ(motion.duration_s > 0, from.name != to.name);
      EXPECT_EQ(motion.energy_j > 0, from.name != to.name);
      EXPECT_LT(motion.duration_s, 60.0);
    }
  }
}

TEST(Motion, TrajectoriesKeepLimitsAndTouchNothing) {
  const MotionModel model(crowded_setup(80));
  const ArmSetup& setup = model.setup();
  CollisionRules bare = setup.collision;
  bare.margin = 1e-9;
  const CollisionChecker exact(setup.arm, bare);
  int searched = 0;
  for (std::size_t i = 0; i + 1 < model.poses().size(); ++i) {
    const Motion motion = model.motion({model.poses()[i].name}, {model.poses()[i + 1].name});
    ASSERT_EQ(motion.status, MotionStatus::found) << motion.detail;
    searched += motion.trajectory.segments.size() > 1 ? 1 : 0;
    for (double t = 0; t <= motion.duration_s; t += 0.01) {
      const JointState state = motion.trajectory.at(t);
      const auto contact = exact.contact(state.position);
      ASSERT_FALSE(contact) << contact->first << " touches " << contact->second << " at " << t;
      ASSERT_TRUE(kinematics::within_limits(setup.arm, state.position, 1e-9));
      for (std::size_t j = 0; j < setup.arm.joints.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        ASSERT_LE(std::abs(state.velocity[row]), setup.arm.joints[j].limits.velocity * (1 + 1e-9));
        ASSERT_LE(std::abs(state.acceleration[row]), setup.arm.joints[j].limits.acceleration * (1 + 1e-9));
      }
    }
    EXPECT_LT((motion.trajectory.at(0).position - model.poses()[i].joints).norm(), 1e-9);
    EXPECT_LT((motion.trajectory.at(motion.duration_s).position - model.poses()[i + 1].joints).norm(), 1e-9);
  }
  EXPECT_GE(searched, 5) << "some ways must need a search, or this test shows too little";
}

TEST(Motion, DoesNotDependOnWhatWasAskedBefore) {
  const MotionModel model(crowded_setup(10)), other(crowded_setup(10));
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& a : model.poses()) {
    for (const auto& b : model.poses()) pairs.emplace_back(a.name, b.name);
  }
  std::vector<std::string> forward, backward(pairs.size());
  for (const auto& [from, to] : pairs) forward.push_back(key_of(model.motion({from}, {to})));
  for (std::size_t i = pairs.size(); i-- > 0;) {
    backward[i] = key_of(other.motion({pairs[i].first}, {pairs[i].second}));
  }
  EXPECT_EQ(forward, backward);
}

TEST(Motion, StartsFromWhereTheArmStands) {
  const MotionModel model(test::rover_setup());
  const JointVector ready = model.poses()[1].joints;
  EXPECT_EQ(key_of(model.motion({"here", ready}, {"sampling"})),
            key_of(model.motion({"ready"}, {"sampling"})));
  EXPECT_EQ(model.motion({"here", coordinates({0, 0.6, 0.8, 0, 0})}, {"sampling"}).status,
            MotionStatus::in_collision);
  EXPECT_EQ(model.motion({"here", coordinates({9, 0, 0, 0, 0})}, {"sampling"}).status,
            MotionStatus::unreachable);
  EXPECT_EQ(key_of(model.motion({"sampling"}, {"here", ready})),
            key_of(model.motion({"sampling"}, {"ready"})));
  EXPECT_EQ(model.motion({"here", coordinates({0, 0})}, {"sampling"}).status, MotionStatus::unreachable);
}

// An arm that stopped a little off its path may stand within the margin of the ground: it still gets away.
TEST(Motion, LeavesAPlaceWithinTheMargin) {
  const ArmSetup setup = test::rover_setup();
  const MotionModel model(setup);
  const CollisionChecker checker(setup.arm, setup.collision);
  JointVector close = model.resolve({"sampling"}).joints;
  while (!checker.contact(close)) close[1] += 1e-3;
  const Motion away = model.motion({"here", close}, {"stow"});
  EXPECT_EQ(away.status, MotionStatus::found) << away.detail;
  close[1] += 0.1;
  EXPECT_EQ(model.motion({"here", close}, {"stow"}).status, MotionStatus::in_collision);
}

TEST(Motion, GivesTheReasonWhenThereIsNone) {
  ArmSetup setup = test::rover_setup();
  setup.poses.push_back({"far", ToolTarget{{3, 0, 0}, {}, {}}});
  setup.poses.push_back({"buried", ToolTarget{{0.95, 0, -0.7}, {}, {}}});
  setup.poses.push_back({"bent", coordinates({0, 2.0, 0, 0, 0})});
  const MotionModel model(setup);
  EXPECT_EQ(model.motion({"stow"}, {"nowhere"}).status, MotionStatus::unknown_pose);
  EXPECT_THAT(model.motion({"stow"}, {"nowhere"}).detail, HasSubstr("no pose 'nowhere'"));
  EXPECT_EQ(model.motion({"nowhere"}, {"stow"}).status, MotionStatus::unknown_pose);
  EXPECT_EQ(model.motion({"stow"}, {"far"}).status, MotionStatus::unreachable);
  EXPECT_EQ(model.motion({"stow"}, {"bent"}).status, MotionStatus::unreachable);
  EXPECT_EQ(model.motion({"stow"}, {"buried"}).status, MotionStatus::in_collision);
  EXPECT_THAT(model.motion({"stow"}, {"buried"}).detail, HasSubstr("touches ground"));
  EXPECT_EQ(model.motion({"stow"}, {"sampling"}, [] { return true; }).status, MotionStatus::cancelled);
}

TEST(Motion, WeakMotorIsOverloaded) {
  ArmSetup setup = test::rover_setup();
  setup.arm.joints[1].limits.effort = 3;
  const Motion motion = MotionModel(setup).motion({"ready"}, {"image"});
  EXPECT_EQ(motion.status, MotionStatus::overloaded);
  EXPECT_THAT(motion.detail, HasSubstr("joint 'shoulder'"));
}

// A fin along the shoulder's axis and a post in the way of its sweep: the azimuth cannot get past, and the
// way round the other side is beyond its limits.
// A reply has ten samples for each second: a motion of hours is none that anybody meant.
TEST(Motion, NoneTakesHours) {
  for (const double speed : {5e-5, 1e-12}) {
    ArmSetup setup = test::rover_setup();
    for (kinematics::Joint& joint : setup.arm.joints) joint.limits.velocity = speed;
    const Motion motion = MotionModel(setup).motion({"ready"}, {"sampling"});
    EXPECT_EQ(motion.status, MotionStatus::no_path);
    EXPECT_FALSE(motion.proved);
    EXPECT_NE(motion.detail.find("none may take over 10000 s; see the speed limits"), std::string::npos);
  }
}

TEST(Motion, SearchEndsWhenThereIsNoWay) {
  ArmSetup setup = test::rover_setup();
  kinematics::CollisionShape fin{"fin", Eigen::Isometry3d::Identity(), kinematics::Box{{0.02, 0.8, 0.02}}};
  fin.pose.translation() = Eigen::Vector3d(0, 0.5, 0);
  kinematics::CollisionShape post{"post", Eigen::Isometry3d::Identity(), kinematics::Box{{0.05, 0.05, 3}}};
  post.pose.translation() = Eigen::Vector3d(0.42 - 0.7 * std::sin(0.8), -0.10 + 0.7 * std::cos(0.8), 0);
  setup.arm.bodies[2].shapes = {fin};
  setup.arm.bodies[0].shapes = {post};
  setup.search_iterations = 200;
  setup.poses = {{"before", coordinates({0, -1, 0, 0, 0})}, {"after", coordinates({1.6, -1, 0, 0, 0})}};
  const Motion motion = MotionModel(setup).motion({"before"}, {"after"});
  EXPECT_EQ(motion.status, MotionStatus::no_path) << motion.detail;
  EXPECT_THAT(motion.detail, HasSubstr("200 search iterations"));
  setup.arm.bodies[0].shapes.clear();
  EXPECT_EQ(MotionModel(setup).motion({"before"}, {"after"}).status, MotionStatus::found)
      << "the post alone shuts the way";
}

TEST(Motion, LowerLimitsChangeValuesAndReach) {
  const MotionModel model(test::rover_setup());
  const double plain = model.motion({"stow"}, {"ready"}).duration_s;

  ArmSetup slow = test::rover_setup();
  for (auto& joint : slow.arm.joints) joint.limits.velocity *= 0.5;
  const MotionModel slow_model(slow);
  EXPECT_GT(slow_model.motion({"stow"}, {"ready"}).duration_s, plain);
  EXPECT_NE(slow_model.version(), model.version());

  ArmSetup short_elbow = test::rover_setup();
  short_elbow.arm.joints[2].limits.upper = 0.4;
  EXPECT_EQ(MotionModel(short_elbow).motion({"stow"}, {"ready"}).status, MotionStatus::unreachable);

  ArmSetup gentle = test::rover_setup();
  for (auto& joint : gentle.arm.joints) joint.limits.acceleration *= 0.25;
  EXPECT_GT(MotionModel(gentle).motion({"stow"}, {"ready"}).duration_s, plain);
}

TEST(Motion, ToolPosesPutTheToolThere) {
  const ArmSetup setup = test::rover_setup();
  const MotionModel model(setup);
  for (std::size_t i = 0; i < setup.poses.size(); ++i) {
    const auto* target = std::get_if<ToolTarget>(&setup.poses[i].where);
    if (target == nullptr) continue;
    const ToolError error = tool_error(setup.arm, model.poses()[i].joints, *target);
    EXPECT_LT(error.position, 1e-4);
    EXPECT_LT(error.angle, 1e-3);
    EXPECT_EQ(model.poses()[i].joints[4], 0.0) << "the free turn about the approach stays at rest";
  }
}

}  // namespace
}  // namespace roci::arm
