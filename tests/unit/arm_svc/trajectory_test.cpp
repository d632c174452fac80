#include "arm_svc/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm_svc/sampling.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

JointPath random_path(const Arm& arm, std::mt19937_64& rng, int points) {
  JointPath path;
  for (int i = 0; i < points; ++i) path.push_back(sample_coordinates(arm, rng));
  return path;
}

TEST(Trajectory, OneJointTakesTheTextbookTime) {
  Arm arm = test::rover_setup().arm;
  arm.joints[0].limits = {-3, 3, 0.5, 0.25, 10};
  JointVector from = JointVector::Zero(5), to = from;
  to[0] = 2.0;  // ramps of 2 s over 0.5 rad each, 1 rad at 0.5 rad/s between them
  EXPECT_NEAR(time_path(arm, {from, to}).duration_s(), 6.0, 1e-12);
  to[0] = 0.25;  // never at full speed: two ramps of 1 s
  EXPECT_NEAR(time_path(arm, {from, to}).duration_s(), 2.0, 1e-12);
  to[0] = -0.25;
  EXPECT_NEAR(line_duration_s(arm, from, to), 2.0, 1e-12);
}

TEST(Trajectory, RespectsLimitsAndVisitsTheWayPointsAtRest) {
  std::mt19937_64 rng(2);
  for (const auto& [name, arm] : test::all_arms()) {
    for (int trial = 0; trial < 40; ++trial) {
      const JointPath path = random_path(arm, rng, 4);
      const Trajectory trajectory = time_path(arm, path);
      const double end = trajectory.duration_s();
      constexpr double kStep = 1e-3;
      JointState before = trajectory.at(0.0);
      EXPECT_LT((before.position - path.front()).norm(), 1e-12);
      for (double t = kStep; t < end; t += kStep) {
        const JointState now = trajectory.at(t);
        for (std::size_t j = 0; j < arm.joints.size(); ++j) {
          const auto row = static_cast<Eigen::Index>(j);
          const auto& limits = arm.joints[j].limits;
          const double moved = now.position[row] - before.position[row];
          const double faster = now.velocity[row] - before.velocity[row];
          ASSERT_LE(std::abs(now.velocity[row]), limits.velocity * (1 + 1e-9)) << name;
          ASSERT_LE(std::abs(now.acceleration[row]), limits.acceleration * (1 + 1e-9)) << name;
          ASSERT_LE(std::abs(faster), limits.acceleration * kStep * (1 + 1e-6)) << "speed is continuous";
          ASSERT_NEAR(moved, 0.5 * kStep * (now.velocity[row] + before.velocity[row]),
                      limits.acceleration * kStep * kStep)
              << "speed is the derivative of position";
        }
        before = now;
      }
      EXPECT_LT((trajectory.at(end).position - path.back()).norm(), 1e-12);
      double begin = 0;
      for (std::size_t i = 0; i < trajectory.segments.size(); ++i) {
        begin += trajectory.segments[i].duration_s();
        EXPECT_LT((trajectory.at(begin).position - path[i + 1]).norm(), 1e-9);
        EXPECT_LT(trajectory.at(begin).velocity.norm(), 1e-9);
      }
    }
  }
}

TEST(Trajectory, IsAsFastAsSomeLimitAllows) {
  std::mt19937_64 rng(4);
  const Arm arm = test::rover_setup().arm;
  for (int trial = 0; trial < 200; ++trial) {
    const TrajectorySegment segment = time_path(arm, random_path(arm, rng, 2)).segments.front();
    const JointState start = state_in(segment, 0.0), middle = state_in(segment, 0.5 * segment.duration_s());
    double acceleration = 0, speed = 0;
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      acceleration =
          std::max(acceleration, std::abs(start.acceleration[row]) / arm.joints[j].limits.acceleration);
      speed = std::max(speed, std::abs(middle.velocity[row]) / arm.joints[j].limits.velocity);
    }
    EXPECT_NEAR(acceleration, 1.0, 1e-9);
    if (segment.cruise_s > 0) {
      EXPECT_NEAR(speed, 1.0, 1e-9);
    }
  }
}

TEST(Trajectory, NoWayTakesNoTime) {
  const Arm arm = test::rover_setup().arm;
  const JointVector q = JointVector::Zero(5);
  EXPECT_TRUE(time_path(arm, {q, q, q}).segments.empty());
  EXPECT_EQ(time_path(arm, {q, q}).duration_s(), 0.0);
}

TEST(Trajectory, SamplesRunFromStartToEndNoFurtherApartThanAsked) {
  std::mt19937_64 rng(6);
  const Arm arm = test::rover_setup().arm;
  const JointPath path = random_path(arm, rng, 3);
  const Trajectory trajectory = time_path(arm, path);
  const auto samples = sampled(trajectory, 0.1);
  EXPECT_EQ(samples.front().position, path.front());
  EXPECT_LT((samples.back().position - path.back()).norm(), 1e-12);
  EXPECT_NEAR(samples.back().time_s, trajectory.duration_s(), 1e-12);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_GT(samples[i].time_s, samples[i - 1].time_s);
    EXPECT_LE(samples[i].time_s - samples[i - 1].time_s, 0.1 + 1e-12);
  }
}

}  // namespace
}  // namespace roci::arm
