// The dynamics of the simulator's arm against what physics says, and against arm_svc's inverse dynamics, which is
// another algorithm.
#include "sim_svc/components/arm_dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "arm_svc/inverse_dynamics.hpp"
#include "tests/unit/core/kinematics/random_arm.hpp"

namespace roci::sim::components {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

const Eigen::Vector3d kGravity(0.3, -0.2, -3.7);

Arm heavy_arm(std::mt19937_64& rng) {
  Arm arm = kinematics::test::random_arm(rng);
  for (auto& body : arm.bodies) {
    Eigen::Matrix3d root;
    for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = kinematics::test::uniform(rng, -0.2, 0.2);
    body.mass.mass = kinematics::test::uniform(rng, 0.5, 3);
    body.mass.centre = kinematics::test::random_vector(rng, 0.15);
    body.mass.inertia = root * root.transpose() + 0.01 * Eigen::Matrix3d::Identity();
  }
  return arm;
}

JointVector random_joints(std::mt19937_64& rng, const Arm& arm, double size) {
  JointVector out(static_cast<Eigen::Index>(arm.joints.size()));
  for (double& value : out) value = kinematics::test::uniform(rng, -size, size);
  return out;
}

// Forward dynamics.
JointVector accelerations(const ArmDynamics& dynamics, const JointVector& q, const JointVector& rate,
                          const JointVector& effort) {
  const MotionEquation motion = dynamics.equation(q, rate);
  return motion.inertia.llt().solve(effort - motion.bias);
}

// A step of the classical Runge-Kutta method without any joint force.
void swing(const ArmDynamics& dynamics, JointVector& q, JointVector& rate, double step) {
  const JointVector no_effort = JointVector::Zero(q.size());
  const auto change = [&](const JointVector& at, const JointVector& with) {
    return accelerations(dynamics, at, with, no_effort);
  };
  const JointVector a1 = change(q, rate);
  const JointVector v2 = rate + step / 2 * a1, a2 = change(q + step / 2 * rate, v2);
  const JointVector v3 = rate + step / 2 * a2, a3 = change(q + step / 2 * v2, v3);
  const JointVector v4 = rate + step * a3, a4 = change(q + step * v3, v4);
  q += step / 6 * (rate + 2 * v2 + 2 * v3 + v4);
  rate += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

TEST(ArmDynamics, IsUndoneByInverseDynamics) {
  std::mt19937_64 rng(4);
  for (int round = 0; round < 200; ++round) {
    const Arm arm = heavy_arm(rng);
    const JointVector q = kinematics::test::random_coordinates(rng, arm), rate = random_joints(rng, arm, 2),
                      effort = random_joints(rng, arm, 30);
    const JointVector change = accelerations(ArmDynamics(arm, kGravity), q, rate, effort);
    const JointVector back = arm::joint_efforts(arm, {q, rate, change}, kGravity);
    EXPECT_LT((back - effort).norm(), 1e-8 * (1 + effort.norm() + change.norm())) << "round " << round;
  }
}

// A load is felt as a body of its mass that is fixed to the tool.
TEST(ArmDynamics, CarriesALoadAsAFixedBody) {
  std::mt19937_64 rng(5);
  const Arm bare = heavy_arm(rng);
  const auto load = held_box(12, {0.4, 0.6, 0.2}, Eigen::Vector3d::UnitX());
  EXPECT_DOUBLE_EQ(load.centre.x(), 0.2);
  EXPECT_NEAR(load.inertia(1, 1), (0.16 + 0.04), 1e-12);
  const JointVector q = kinematics::test::random_coordinates(rng, bare), rate = random_joints(rng, bare, 1);
  const ArmDynamics without(bare, kGravity), with(bare, kGravity, load);
  const Eigen::Index rows = without.joints();
  const JointVector held =
      with.equation(q, JointVector::Zero(rows)).bias - without.equation(q, JointVector::Zero(rows)).bias;
  EXPECT_GT(held.norm(), 0.1);
  const MotionEquation equation = with.equation(q, rate);
  EXPECT_LT((equation.inertia - equation.inertia.transpose()).norm(), 1e-12);
}

TEST(ArmDynamics, ConservesEnergyWithoutForces) {
  std::mt19937_64 rng(6);
  for (int round = 0; round < 3; ++round) {
    const Arm arm = heavy_arm(rng);
    const ArmDynamics dynamics(arm, kGravity, held_box(5, {}, Eigen::Vector3d::UnitX()));
    JointVector q = kinematics::test::random_coordinates(rng, arm), rate = random_joints(rng, arm, 0.5);
    const double before = dynamics.energy_j(q, rate);
    const JointVector start = q;
    for (int i = 0; i < 400; ++i) swing(dynamics, q, rate, 0.001);
    EXPECT_GT((q - start).norm(), 0.05);
    EXPECT_NEAR(dynamics.energy_j(q, rate), before, 1e-5 * (1 + std::abs(before)));
  }
}

// The period of a pendulum of any amplitude is that of a small one over the arithmetic-geometric mean of 1 and the
// cosine of half the amplitude (Gauss).
TEST(ArmDynamics, SwingsAsAPendulum) {
  constexpr double kLength = 0.7, kAmplitude = 2.0, kG = 9.81;
  Arm arm;
  arm.joints.resize(1);
  arm.joints[0].axis = Eigen::Vector3d::UnitY();
  arm.bodies.resize(2);
  arm.bodies[1].mass = {2.5, {0, 0, -kLength}, Eigen::Matrix3d::Zero()};
  const ArmDynamics dynamics(arm, {0, 0, -kG});
  double a = 1, g = std::cos(kAmplitude / 2);
  for (int i = 0; i < 6; ++i) {
    const double mean = (a + g) / 2;
    g = std::sqrt(a * g);
    a = mean;
  }
  const double period = 2 * std::numbers::pi * std::sqrt(kLength / kG) / a;
  JointVector q = JointVector::Constant(1, kAmplitude), rate = JointVector::Zero(1);
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) swing(dynamics, q, rate, period / kSteps);
  EXPECT_NEAR(q[0], kAmplitude, 1e-6);
  EXPECT_NEAR(rate[0], 0, 1e-6);
}

}  // namespace
}  // namespace roci::sim::components
