#include "sim_svc/components/driven_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/walker.hpp"

namespace roci::sim::components {
namespace {

using kinematics::JointVector;
using temporal::Time;
using temporal::to_seconds;

constexpr double kCourse = 6;  // s

JointsWear worn(Eigen::Index joint, double friction, double growth = 0) {
  JointsWear out{JointVector::Zero(4), JointVector::Zero(4)};
  out.friction[joint] = friction;
  out.growth[joint] = growth;
  return out;
}

// From home to s1 with 80 kg at the tool as the controller believes.
ArmTrace carried(double true_kg, const JointsWear& wear = worn(0, 0), DrivenArmParameters parameters = {}) {
  parameters.arm = rail_arm();
  const std::vector<double> size{0.5, 0.5, 0.5};
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
  return DrivenMotion(parameters, joints_at("home"), wear,
                      {{0, joints_at("home")}, {kCourse, joints_at("s1")}}, held_box(80, size, ahead),
                      held_box(true_kg, size, ahead), 1)
      .trace(Time{});
}

double duration(const ArmTrace& trace) { return to_seconds(trace.end() - trace.start); }

TEST(DrivenMotion, SettlesAtTheTargetSoonAfterTheCourseEnds) {
  const ArmTrace trace = carried(80);
  EXPECT_EQ(trace.stalled, "");
  EXPECT_GE(duration(trace), kCourse);
  EXPECT_LT(duration(trace), kCourse + 4);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(trace.samples.back().joints[i], joints_at("s1")[i], 0.005);
  EXPECT_GT(trace.samples.back().energy_j, 15 * kCourse);
  for (std::size_t i = 1; i < trace.samples.size(); ++i)
    EXPECT_GE(trace.samples[i].energy_j, trace.samples[i - 1].energy_j);
}

TEST(DrivenMotion, IsTheSameEveryTime) {
  const ArmTrace one = carried(95), other = carried(95);
  ASSERT_EQ(one.samples.size(), other.samples.size());
  EXPECT_EQ(one.samples.back().joints, other.samples.back().joints);
  EXPECT_EQ(one.samples.back().energy_j, other.samples.back().energy_j);
}

TEST(DrivenMotion, ALoadHeavierThanToldTakesLongerAndMore) {
  const ArmTrace told = carried(80), heavy = carried(240), heavier = carried(480);
  EXPECT_GT(duration(heavy), duration(told));
  EXPECT_GT(duration(heavier), duration(heavy) + 1);
  EXPECT_GT(heavier.samples.back().energy_j, told.samples.back().energy_j);
  EXPECT_EQ(heavier.stalled, "");
}

TEST(DrivenMotion, AStifferJointTakesLongerAndAtLastStandsStill) {
  double before = duration(carried(80));
  for (const double share : {0.7, 0.85}) {
    const ArmTrace slow = carried(80, worn(2, share * 80));
    EXPECT_EQ(slow.stalled, "") << share;
    EXPECT_GT(duration(slow), before + 0.5) << share;
    before = duration(slow);
  }
  const ArmTrace stuck = carried(80, worn(2, 1.1 * 80));
  EXPECT_THAT(stuck.stalled, testing::HasSubstr("joint 'elbow' stands "));
  EXPECT_THAT(stuck.stalled, testing::HasSubstr("80.000 N·m"));
  EXPECT_LT(duration(stuck), 120);
}

TEST(DrivenMotion, AJointWearsByItsTravel) {
  DrivenArmParameters parameters;
  parameters.arm = rail_arm();
  const DrivenMotion motion(parameters, joints_at("home"), worn(2, 0, 4),
                            {{0, joints_at("home")}, {kCourse, joints_at("s1")}}, {}, {}, 1);
  const JointsWear& after = motion.wear_at(1000000);
  EXPECT_NEAR(after.friction[2], 4 * 1.0, 0.3);  // the elbow travels by 1 rad
  EXPECT_EQ(after.friction[1], 0);
}

TEST(DrivenMotion, WeakMotorsTakeLonger) {
  DrivenArmParameters weak;
  weak.motor_strength = 0.2;
  EXPECT_GT(duration(carried(80, worn(0, 0), weak)), duration(carried(80)) + 0.5);
}

// The rest of a motion that is worked out anew joins what was before.
TEST(DrivenMotion, GoesOnFromAnyMomentWithOtherFriction) {
  DrivenArmParameters parameters;
  parameters.arm = rail_arm();
  DrivenMotion motion(parameters, joints_at("home"), worn(2, 0),
                      {{0, joints_at("home")}, {kCourse, joints_at("s1")}}, {}, {}, 1);
  const ArmTrace before = motion.trace(Time{});
  motion.go_on_from(40, worn(2, 0));
  const ArmTrace same = motion.trace(Time{});
  ASSERT_EQ(same.samples.size(), before.samples.size());
  EXPECT_EQ(same.samples.back().joints, before.samples.back().joints);
  motion.go_on_from(40, worn(2, 70));
  const ArmTrace slower = motion.trace(Time{});
  EXPECT_EQ(slower.samples[40].joints, before.samples[40].joints);
  EXPECT_GT(duration(slower), duration(before));
}

TEST(JointCourse, GoesThroughItsPointsSmoothlyAndRestsAtItsEnds) {
  const JointCourse course({{0, {0, 1}}, {1, {0.5, 1}}, {1, {0.6, 1}}, {3, {2, 0}}});
  EXPECT_DOUBLE_EQ(course.duration_s(), 3);
  EXPECT_NEAR(course.at(1).position[0], 0.6, 1e-12);
  EXPECT_EQ(course.at(-1).position[0], 0);
  EXPECT_EQ(course.at(9).position[0], 2);
  EXPECT_NEAR(course.at(0).rate.norm(), 0, 1e-12);
  EXPECT_EQ(course.at(3).rate.norm(), 0);
  for (double t = 0.05; t < 3; t += 0.1) {
    const double h = 1e-5;
    const JointVector rate = (course.at(t + h).position - course.at(t - h).position) / (2 * h);
    EXPECT_LT((rate - course.at(t).rate).norm(), 1e-6) << t;
    const JointVector change = (course.at(t + h).rate - course.at(t - h).rate) / (2 * h);
    EXPECT_LT((change - course.at(t).change).norm(), 1e-5) << t;
  }
}

}  // namespace
}  // namespace roci::sim::components
