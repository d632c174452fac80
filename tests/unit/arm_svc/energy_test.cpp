#include "arm_svc/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm_svc/inverse_dynamics.hpp"
#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"
#include "tests/unit/core/kinematics/random_arm.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

const Eigen::Vector3d kGravity(0.3, -0.2, -3.7);

// Random chains, slides among them, with random masses: every term of the dynamics takes part.
std::vector<Arm> heavy_arms() {
  std::mt19937_64 rng(8);
  std::vector<Arm> arms;
  for (int i = 0; i < 8; ++i) {
    Arm arm = kinematics::test::random_arm(rng);
    for (auto& body : arm.bodies) {
      const Eigen::Matrix3d root = 0.2 * Eigen::Matrix3d::NullaryExpr([&] { return unit_sample(rng) - 0.5; });
      body.mass.mass = 0.5 + unit_sample(rng);
      body.mass.centre = kinematics::test::random_vector(rng, 0.15);
      body.mass.inertia = root * root.transpose() + 0.01 * Eigen::Matrix3d::Identity();
    }
    arms.push_back(arm);
  }
  return arms;
}

double potential(const Arm& arm, const JointVector& q) {
  const auto poses = kinematics::body_poses(arm, q);
  double energy = 0;
  for (std::size_t b = 1; b < poses.size(); ++b) {
    energy -= arm.bodies[b].mass.mass * kGravity.dot(poses[b] * arm.bodies[b].mass.centre);
  }
  return energy;
}

// From positions alone: body velocities by central differences.
double kinetic(const Arm& arm, const JointVector& q, const JointVector& rate) {
  constexpr double kStep = 1e-5;
  const auto now = kinematics::body_poses(arm, q);
  const auto before = kinematics::body_poses(arm, q - kStep * rate),
             after = kinematics::body_poses(arm, q + kStep * rate);
  double energy = 0;
  for (std::size_t b = 1; b < now.size(); ++b) {
    const auto& mass = arm.bodies[b].mass;
    const Eigen::Vector3d speed = (after[b] * mass.centre - before[b] * mass.centre) / (2 * kStep);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(after[b].linear() * before[b].linear().transpose()));
    const Eigen::Vector3d spin = turn.angle() * turn.axis() / (2 * kStep);
    const Eigen::Matrix3d inertia = now[b].linear() * mass.inertia * now[b].linear().transpose();
    energy += 0.5 * mass.mass * speed.squaredNorm() + 0.5 * spin.dot(inertia * spin);
  }
  return energy;
}

TEST(InverseDynamics, HoldingEffortIsTheGradientOfPotentialEnergy) {
  std::mt19937_64 rng(9);
  constexpr double kStep = 1e-5;
  for (const Arm& arm : heavy_arms()) {
    for (int trial = 0; trial < 50; ++trial) {
      const JointVector q = sample_coordinates(arm, rng), rest = JointVector::Zero(q.size());
      const JointVector efforts = joint_efforts(arm, {q, rest, rest}, kGravity);
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        JointVector low = q, high = q;
        low[j] -= kStep;
        high[j] += kStep;
        EXPECT_NEAR(efforts[j], (potential(arm, high) - potential(arm, low)) / (2 * kStep), 1e-6);
      }
    }
  }
}

TEST(InverseDynamics, JointPowerIsTheRateOfTotalEnergy) {
  std::mt19937_64 rng(10);
  constexpr double kStep = 1e-3;
  for (const Arm& arm : heavy_arms()) {
    for (int trial = 0; trial < 50; ++trial) {
      const JointVector q = sample_coordinates(arm, rng);
      const JointVector rate = sample_coordinates(arm, rng), change = sample_coordinates(arm, rng);
      const auto energy_at = [&](double t) {
        const JointVector position = q + t * rate + 0.5 * t * t * change, speed = rate + t * change;
        return potential(arm, position) + kinetic(arm, position, speed);
      };
      const double power = joint_efforts(arm, {q, rate, change}, kGravity).dot(rate);
      const double slope = (energy_at(kStep) - energy_at(-kStep)) / (2 * kStep);
      EXPECT_NEAR(power, slope, 1e-2 * (1.0 + std::abs(slope)));
    }
  }
}

Trajectory line(const Arm& arm, const JointVector& to) {
  return time_path(arm, {JointVector::Zero(to.size()), to});
}

JointVector shoulder_down(double angle) {
  JointVector q = JointVector::Zero(5);
  q[1] = angle;
  return q;
}

TEST(Energy, IdlePowerAloneIsPowerTimesTime) {
  const Arm arm = test::rover_setup().arm;
  Arm massless = arm;
  for (auto& body : massless.bodies) body.mass = {};
  for (auto& joint : massless.joints) joint.friction = joint.damping = 0;
  MotorModel motor;
  motor.idle_w = 5;
  const Trajectory way = line(arm, shoulder_down(-1.0));
  EXPECT_NEAR(energy_of(massless, way, motor).energy_j, 5 * way.duration_s(), 1e-9);
}

// Without losses, a lift costs its potential energy and a lowering nothing (it brakes).
TEST(Energy, LosslessSlowLiftCostsThePotentialEnergy) {
  Arm arm = test::rover_setup().arm;
  for (auto& joint : arm.joints) {
    joint.friction = joint.damping = 0;
    joint.limits.velocity = joint.limits.acceleration = 1e-3;
  }
  MotorModel motor;
  motor.gravity = kGravity;
  motor.efficiency = 1.0;
  const JointVector up = shoulder_down(-0.5), level = shoulder_down(0.0);
  const double lift = potential(arm, up) - potential(arm, level);
  ASSERT_GT(lift, 1.0);
  EXPECT_NEAR(energy_of(arm, time_path(arm, {level, up}), motor).energy_j, lift, 0.01 * lift);
  EXPECT_NEAR(energy_of(arm, time_path(arm, {up, level}), motor).energy_j, 0.0, 0.01 * lift);
}

TEST(Energy, GrowsWithEveryLossAndWithGravity) {
  const ArmSetup setup = test::rover_setup();
  const Trajectory way = line(setup.arm, shoulder_down(-1.0));
  const double plain = energy_of(setup.arm, way, setup.motor).energy_j;
  MotorModel motor = setup.motor;
  motor.full_effort_loss_w *= 2;
  EXPECT_GT(energy_of(setup.arm, way, motor).energy_j, plain);
  motor = setup.motor;
  motor.efficiency *= 0.5;
  EXPECT_GT(energy_of(setup.arm, way, motor).energy_j, plain);
  motor = setup.motor;
  motor.gravity *= 2;
  EXPECT_GT(energy_of(setup.arm, way, motor).energy_j, plain);
  Arm stiff = setup.arm;
  for (auto& joint : stiff.joints) joint.friction *= 2;
  EXPECT_GT(energy_of(stiff, way, setup.motor).energy_j, plain);
}

TEST(Energy, LongerWayInOneDirectionCostsMore) {
  const ArmSetup setup = test::rover_setup();
  double last = 0;
  for (double angle = 0.1; angle <= 2.5; angle += 0.1) {
    const double now = energy_of(setup.arm, line(setup.arm, shoulder_down(-angle)), setup.motor).energy_j;
    EXPECT_GT(now, last) << angle;
    last = now;
  }
}

TEST(Energy, StepIsFineEnough) {
  const ArmSetup setup = test::rover_setup();
  const Trajectory way = line(setup.arm, shoulder_down(-1.7));
  const double coarse = energy_of(setup.arm, way, setup.motor, 0.05).energy_j;
  EXPECT_NEAR(coarse, energy_of(setup.arm, way, setup.motor, 0.001).energy_j, 1e-3 * coarse);
}

}  // namespace
}  // namespace roci::arm
