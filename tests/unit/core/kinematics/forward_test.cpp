#include "core/kinematics/forward.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/core/kinematics/random_arm.hpp"

namespace roci::kinematics {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

Joint turning(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis) {
  Joint joint;
  joint.origin.translation() = origin;
  joint.axis = axis;
  joint.limits = {-3, 3, 1, 1, 1};
  return joint;
}

// A yaw joint 0.1 up, three pitch joints with links of 0.5, 0.4 and 0.2 m along x.
Arm textbook_arm() {
  Arm arm;
  arm.joints = {turning({0, 0, 0.1}, {0, 0, 1}), turning({0, 0, 0}, {0, 1, 0}),
                turning({0.5, 0, 0}, {0, 1, 0}), turning({0.4, 0, 0}, {0, 1, 0})};
  arm.bodies.resize(5);
  arm.tool.translation() = Eigen::Vector3d(0.2, 0, 0);
  return arm;
}

JointVector coordinates(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

void expect_position(const JointVector& q, const Eigen::Vector3d& expected) {
  EXPECT_LT((tool_pose(textbook_arm(), q).translation() - expected).norm(), 1e-12) << q.transpose();
}

TEST(ForwardKinematics, MatchesPosesWorkedOutByHand) {
  expect_position(coordinates({0, 0, 0, 0}), {1.1, 0, 0.1});
  expect_position(coordinates({kQuarter, 0, 0, 0}), {0, 1.1, 0.1});
  expect_position(coordinates({0, -kQuarter, 0, 0}), {0, 0, 1.2});
  expect_position(coordinates({0, 0, kQuarter, 0}), {0.5, 0, -0.5});
  expect_position(coordinates({0, -kQuarter, kQuarter, 0}), {0.6, 0, 0.6});
  expect_position(coordinates({-kQuarter, -kQuarter, kQuarter, kQuarter}), {0, -0.4, 0.4});
}

TEST(ForwardKinematics, TurnsTheToolAsWorkedOutByHand) {
  const Eigen::Isometry3d tool = tool_pose(textbook_arm(), coordinates({kQuarter, 0, kQuarter, 0}));
  Eigen::Matrix3d expected;  // tool x down, y back along -x of the base, z along y
  expected.col(0) = -Eigen::Vector3d::UnitZ();
  expected.col(1) = -Eigen::Vector3d::UnitX();
  expected.col(2) = Eigen::Vector3d::UnitY();
  EXPECT_LT((tool.linear() - expected).norm(), 1e-12);
}

TEST(ForwardKinematics, PrismaticJointSlidesAlongItsAxis) {
  Arm arm = textbook_arm();
  arm.joints[3].type = JointType::prismatic;
  arm.joints[3].axis = Eigen::Vector3d::UnitX();
  const auto tool = tool_pose(arm, coordinates({0, 0, kQuarter, 0.3}));
  EXPECT_LT((tool.translation() - Eigen::Vector3d(0.5, 0, -0.8)).norm(), 1e-12);
}

TEST(Jacobian, MatchesCentralDifferencesOnRandomArms) {
  std::mt19937_64 rng(7);
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    const Arm arm = test::random_arm(rng);
    const JointVector q = test::random_coordinates(rng, arm);
    const Jacobian jacobian = tool_jacobian(arm, body_poses(arm, q));
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      JointVector low = q, high = q;
      low[j] -= kStep;
      high[j] += kStep;
      const Eigen::Isometry3d before = tool_pose(arm, low), after = tool_pose(arm, high);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(after.linear() * before.linear().transpose()));
      Eigen::Matrix<double, 6, 1> difference;
      difference << after.translation() - before.translation(), turn.angle() * turn.axis();
      EXPECT_LT((difference / (2 * kStep) - jacobian.col(j)).norm(), 1e-6)
          << "trial " << trial << " joint " << j;
    }
  }
}

TEST(DisplacementBounds, HoldForRandomArmsAndSteps) {
  std::mt19937_64 rng(11);
  for (int trial = 0; trial < 300; ++trial) {
    const Arm arm = test::random_arm(rng);
    const JointVector from = test::random_coordinates(rng, arm), to = test::random_coordinates(rng, arm);
    const double bound = displacement_bounds(arm).dot((to - from).cwiseAbs());
    const auto before = body_poses(arm, from), after = body_poses(arm, to);
    for (std::size_t b = 1; b < arm.bodies.size(); ++b) {
      const CollisionShape& shape = arm.bodies[b].shapes.front();
      const auto& capsule = std::get<Capsule>(shape.form);
      for (double end : {-0.5, 0.5}) {
        const Eigen::Vector3d point = shape.pose * Eigen::Vector3d(0, 0, end * capsule.length);
        EXPECT_LE((after[b] * point - before[b] * point).norm(), bound + 1e-9);
      }
    }
    EXPECT_LE((tool_pose(arm, to).translation() - tool_pose(arm, from).translation()).norm(), bound + 1e-9);
  }
}

TEST(DisplacementBounds, AreReachedByAStretchedArm) {
  const JointVector bounds = displacement_bounds(textbook_arm());
  EXPECT_DOUBLE_EQ(bounds[0], 1.1);
  EXPECT_DOUBLE_EQ(bounds[1], 1.1);
  EXPECT_DOUBLE_EQ(bounds[3], 0.2);
}

TEST(Limits, ClampedCoordinatesAreWithinAndNanIsNot) {
  const Arm arm = textbook_arm();
  const JointVector wild = coordinates({9, -9, 0, 2});
  EXPECT_FALSE(within_limits(arm, wild));
  EXPECT_TRUE(within_limits(arm, clamp_to_limits(arm, wild)));
  EXPECT_FALSE(within_limits(arm, coordinates({0, 0, 0, std::nan("")})));
  EXPECT_FALSE(within_limits(arm, coordinates({0, 0, 0})));
}

}  // namespace
}  // namespace roci::kinematics
