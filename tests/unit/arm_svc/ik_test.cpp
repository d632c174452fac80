#include "arm_svc/ik.hpp"

#include <gtest/gtest.h>

#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

enum class Wanted { position, approach, orientation };

struct Tally {
  int asked = 0;
  int solved = 0;
  double rate() const { return static_cast<double>(solved) / asked; }
};

ToolTarget target_at(const Eigen::Isometry3d& pose, Wanted wanted) {
  ToolTarget target;
  target.position = pose.translation();
  if (wanted == Wanted::approach) target.approach = Approach{Eigen::Vector3d::UnitX(), pose.linear().col(0)};
  if (wanted == Wanted::orientation) target.orientation = Eigen::Quaterniond(pose.linear());
  return target;
}

// Targets that random joint values within the limits reach; the first start is always the same.
Tally solve_random_targets(const Arm& arm, Wanted wanted, int count) {
  std::mt19937_64 rng(5);
  const JointVector start = JointVector::Zero(static_cast<Eigen::Index>(arm.joints.size()));
  Tally tally;
  for (; tally.asked < count; ++tally.asked) {
    const ToolTarget target = target_at(kinematics::tool_pose(arm, sample_coordinates(arm, rng)), wanted);
    for (const JointVector& q : solve_ik(arm, target, start, {})) {
      ++tally.solved;
      EXPECT_TRUE(kinematics::within_limits(arm, q));
      const ToolError error = tool_error(arm, q, target);
      EXPECT_LT(error.position, 1e-4);
      EXPECT_LT(error.angle, 1e-3);
      EXPECT_LT((kinematics::tool_pose(arm, q).translation() - target.position).norm(), 1e-4);
    }
  }
  return tally;
}

void report(const std::string& what, const test::NamedArm& arm, const Tally& tally) {
  const std::string rate = std::to_string(100.0 * tally.rate()) + " % of " + std::to_string(tally.asked);
  testing::Test::RecordProperty(what + "_" + arm.name, rate);
  std::cout << what << " on " << arm.name << ": " << rate << '\n';
}

TEST(Ik, FindsAtLeast99PercentOfReachablePositionsOnEveryArm) {
  for (const auto& arm : test::all_arms()) {
    const Tally tally = solve_random_targets(arm.arm, Wanted::position, 1000);
    report("position", arm, tally);
    EXPECT_GE(tally.rate(), 0.99) << arm.name;
  }
}

TEST(Ik, FindsAtLeast99PercentOfReachableApproachesWithFiveJointsOrMore) {
  for (const auto& arm : test::all_arms()) {
    if (arm.arm.joints.size() < 5) continue;
    const Tally tally = solve_random_targets(arm.arm, Wanted::approach, 500);
    report("approach", arm, tally);
    EXPECT_GE(tally.rate(), 0.99) << arm.name;
  }
}

TEST(Ik, FindsAtLeast99PercentOfReachableOrientations) {
  for (const auto& arm : test::all_arms()) {
    const Tally tally = solve_random_targets(arm.arm, Wanted::orientation, 500);
    report("orientation", arm, tally);
    EXPECT_GE(tally.rate(), 0.99) << arm.name;
  }
}

TEST(Ik, GivesNothingForATargetOutOfReach) {
  const Arm arm = test::rover_setup().arm;
  ToolTarget target;
  target.position = Eigen::Vector3d(3, 0, 0);
  EXPECT_TRUE(solve_ik(arm, target, JointVector::Zero(5), {}).empty());
}

TEST(Ik, GivesDistinctSolutionsAndTheSameOnesEachTime) {
  const Arm arm = test::rover_setup().arm;
  IkOptions options;
  options.solutions = 8;
  ToolTarget target;
  target.position = Eigen::Vector3d(0.9, 0.1, -0.2);
  const auto first = solve_ik(arm, target, JointVector::Zero(5), options);
  const auto second = solve_ik(arm, target, JointVector::Zero(5), options);
  ASSERT_GE(first.size(), 2u);
  EXPECT_EQ(first, second);
  for (std::size_t i = 1; i < first.size(); ++i) EXPECT_GE((first[i] - first[0]).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(Ik, ApproachTurnsTheToolAxisAndLeavesTheTurnAboutItFree) {
  const Arm arm = test::rover_setup().arm;
  ToolTarget target;
  target.position = Eigen::Vector3d(0.95, 0, -0.4);
  target.approach = Approach{Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ()};
  const auto solutions = solve_ik(arm, target, JointVector::Zero(5), {});
  ASSERT_EQ(solutions.size(), 1u);
  const Eigen::Isometry3d tool = kinematics::tool_pose(arm, solutions[0]);
  EXPECT_LT((tool.linear().col(0) + Eigen::Vector3d::UnitZ()).norm(), 1e-3);
}

}  // namespace
}  // namespace roci::arm
