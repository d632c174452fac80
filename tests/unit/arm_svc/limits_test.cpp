// Trajectories keep inside jerk and effort limits, and the bounds of duration and energy stay below them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm_svc/motion.hpp"
#include "arm_svc/sampling.hpp"
#include "arm_svc/slow_down.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

Arm one_joint(double speed, double acceleration, double jerk) {
  Arm arm = test::rover_setup().arm;
  arm.joints[0].limits = {-100, 100, speed, acceleration, 10, jerk};
  return arm;
}

double time_for(const Arm& arm, double way) {
  JointVector from = JointVector::Zero(5), to = from;
  to[0] = way;
  return time_path(arm, {from, to}).duration_s();
}

// The four cases of Biagiotti, Melchiorri, section 3.4, worked out by hand.
TEST(DoubleS, OneJointTakesTheTextbookTime) {
  const Arm arm = one_joint(2.0, 1.0, 1.0);  // 1 s to the acceleration limit, 3 s to the speed limit
  EXPECT_NEAR(time_for(arm, 10.0), 3.0 + 2.0 + 3.0, 1e-9) << "all limits: 3 m in either ramp, 4 m between";
  EXPECT_NEAR(time_for(arm, 6.0), 6.0, 1e-9) << "just at full speed";
  EXPECT_NEAR(time_for(arm, 2.0), 4.0, 1e-9) << "just at full acceleration";
  EXPECT_NEAR(time_for(arm, 0.25), 4.0 * std::cbrt(0.125), 1e-9) << "jerk alone: 2 j t³";
  EXPECT_NEAR(time_for(one_joint(0.25, 1.0, 1.0), 1.0), 4.0 + 1.0, 1e-9)
      << "full speed without full acceleration";
  EXPECT_NEAR(time_for(one_joint(2.0, 1.0, 1e9), 10.0), time_for(one_joint(2.0, 1.0, 0), 10.0), 1e-6)
      << "a trapezoid in the end";
}

TEST(DoubleS, RespectsAllLimitsAndGoesAllTheWay) {
  std::mt19937_64 rng(3);
  const Arm arm = test::rail_setup().arm;
  for (int trial = 0; trial < 60; ++trial) {
    const JointVector from = sample_coordinates(arm, rng);
    const double share = trial % 2 == 0 ? 1.0 : 0.01;  // long ways and short ones
    const JointVector to = from + share * (sample_coordinates(arm, rng) - from);
    const Trajectory trajectory = time_path(arm, {from, to});
    const double end = trajectory.duration_s(), step = end / 400;
    JointState before = trajectory.at(0);
    EXPECT_LT((before.position - from).norm(), 1e-12);
    for (int i = 1; i <= 400; ++i) {
      const JointState now = trajectory.at(i * step * (1 - 1e-12));
      for (Eigen::Index j = 0; j < now.position.size(); ++j) {
        const auto& limits = arm.joints[static_cast<std::size_t>(j)].limits;
        ASSERT_LE(std::abs(now.velocity[j]), limits.velocity * (1 + 1e-9));
        ASSERT_LE(std::abs(now.acceleration[j]), limits.acceleration * (1 + 1e-9));
        ASSERT_LE(std::abs(now.acceleration[j] - before.acceleration[j]), limits.jerk * step * (1 + 1e-6));
        ASSERT_NEAR(now.velocity[j] - before.velocity[j],
                    0.5 * step * (now.acceleration[j] + before.acceleration[j]), limits.jerk * step * step)
            << "acceleration is the derivative of speed";
        ASSERT_NEAR(now.position[j] - before.position[j], 0.5 * step * (now.velocity[j] + before.velocity[j]),
                    limits.acceleration * step * step)
            << "speed is the derivative of position";
      }
      before = now;
    }
    EXPECT_LT((trajectory.at(end).position - to).norm(), 1e-12);
    EXPECT_LT(trajectory.at(end).velocity.norm(), 1e-12);
  }
}

// No way between the two beats the bound, and a straight line of one joint meets it.
TEST(DurationBound, IsBelowEveryWay) {
  std::mt19937_64 rng(4);
  for (const Arm& arm : {test::rail_setup().arm, test::rover_setup().arm}) {
    for (int trial = 0; trial < 300; ++trial) {
      JointPath path;
      for (int i = 0; i < 2 + trial % 3; ++i) path.push_back(sample_coordinates(arm, rng));
      const double bound = duration_bound_s(arm, path.front(), path.back());
      EXPECT_LE(bound, time_path(arm, path).duration_s());
      JointVector turned = path.front();
      turned[0] = path.back()[0];
      EXPECT_NEAR(duration_bound_s(arm, path.front(), turned),
                  time_path(arm, {path.front(), turned}).duration_s(), 1e-6);
    }
  }
}

TEST(EnergyBound, IsBelowEveryWay) {
  std::mt19937_64 rng(5);
  for (const ArmSetup& setup : {test::rail_setup(), test::rover_setup()}) {
    double tightest = 0;
    for (int trial = 0; trial < 60; ++trial) {
      JointPath path;
      for (int i = 0; i < 2 + trial % 3; ++i) path.push_back(sample_coordinates(setup.arm, rng));
      const Arm arm = loaded(setup.arm, {trial % 2 * 5.0, {0.1, 0.1, 0.1}}, setup.tool_axis);
      const double bound = energy_bound_j(arm, path.front(), path.back(), setup.motor);
      const double energy = energy_of(arm, time_path(arm, path), setup.motor).energy_j;
      EXPECT_LE(bound, energy);
      tightest = std::max(tightest, bound / energy);
    }
    EXPECT_GT(tightest, 0.5);
  }
}

// Lower <= exact for whole motions, searched ones among them, with loads and without.
TEST(MotionBound, IsBelowTheMotion) {
  std::mt19937_64 rng(6);
  for (const ArmSetup& setup : {test::rail_setup(), test::rover_setup()}) {
    const MotionModel model(setup);
    for (int trial = 0; trial < 10; ++trial) {
      const ResolvedPlace from = model.resolve({"a", sample_coordinates(setup.arm, rng)});
      const ResolvedPlace to = trial % 2 == 0
                                   ? model.poses()[static_cast<std::size_t>(trial) % model.poses().size()]
                                   : model.resolve({"b", sample_coordinates(setup.arm, rng)});
      const Payload payload{trial % 3 * 1.0, Eigen::Vector3d::Constant(trial % 3 * 0.05)};
      const Motion motion = model.plan(from, to, payload, 1, {});
      const MotionBound bound = model.bound(from, to, payload);
      if (bound.status != MotionStatus::found) {
        EXPECT_NE(motion.status, MotionStatus::found);
      } else if (motion.status == MotionStatus::found) {
        EXPECT_LE(bound.duration_s, motion.duration_s);
        EXPECT_LE(bound.energy_j, motion.energy_j);
      }
    }
  }
}

TEST(SlowDown, KeepsTheMotorsInside) {
  const ArmSetup setup = test::rail_setup();
  const Arm arm = loaded(setup.arm, {2000, {0.4, 0.4, 0.4}}, setup.tool_axis);
  JointVector to = JointVector::Zero(7);
  to << 1.0, 0.5, -1.0, 0.5, 0, 0, 0;
  Trajectory trajectory = time_path(arm, {JointVector::Zero(7), to});
  const double fast = trajectory.duration_s();
  ASSERT_GT(energy_of(arm, trajectory, setup.motor).peak_load, 1.0);
  EXPECT_FALSE(slow_down(arm, setup.motor, trajectory));
  EXPECT_LE(energy_of(arm, trajectory, setup.motor).peak_load, 1.0 + 1e-6);
  EXPECT_GT(trajectory.duration_s(), 1.2 * fast);
  EXPECT_LT((trajectory.at(trajectory.duration_s()).position - to).norm(), 1e-12);
}

TEST(SlowDown, LeavesAloneWhatTheMotorsCanDoAndTellsWhatTheyCannot) {
  const ArmSetup setup = test::rover_setup();
  JointVector to = JointVector::Zero(5);
  to[1] = -1.0;
  Trajectory trajectory = time_path(setup.arm, {JointVector::Zero(5), to});
  const double duration = trajectory.duration_s();
  EXPECT_FALSE(slow_down(setup.arm, setup.motor, trajectory));
  EXPECT_EQ(trajectory.duration_s(), duration);
  const Arm heavy = loaded(setup.arm, {60, {0, 0, 0}}, setup.tool_axis);
  const auto most = slow_down(heavy, setup.motor, trajectory);
  ASSERT_TRUE(most) << "60 kg a metre away hang on the shoulder however slowly it turns";
  EXPECT_EQ(most->joint, 1U);
  EXPECT_GT(most->load, 1.0);
}

}  // namespace
}  // namespace roci::arm
