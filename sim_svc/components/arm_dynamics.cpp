#include "sim_svc/components/arm_dynamics.hpp"

#include <Eigen/Cholesky>

#include "core/kinematics/mass.hpp"

namespace roci::sim::components {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using kinematics::JointVector;

// A joint's axis as a motion (turn, slide) and the inertia of its body, all about the base's origin.
struct ArmDynamics::Spatial {
  Vector3d turn;
  Vector3d slide;
  double mass;
  Vector3d moment;  // mass times centre
  Matrix3d inertia;

  Vector3d momentum(const Vector3d& turning, const Vector3d& sliding) const {
    return mass * sliding + turning.cross(moment);
  }
  Vector3d angular_momentum(const Vector3d& turning, const Vector3d& sliding) const {
    return inertia * turning + moment.cross(sliding);
  }
};

ArmDynamics::ArmDynamics(const kinematics::Arm& arm, const Vector3d& gravity,
                         const kinematics::MassProperties& load, const std::vector<double>& rotor_inertia)
    : gravity_(gravity) {
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const kinematics::Joint& joint = arm.joints[i];
    kinematics::MassProperties body = arm.bodies[i + 1].mass;
    if (i + 1 == arm.joints.size()) body = kinematics::joined(body, kinematics::moved(load, arm.tool));
    links_.push_back({joint.type == kinematics::JointType::revolute, joint.origin.linear(),
                      joint.origin.translation(), joint.axis, body.mass, body.centre, body.inertia,
                      i < rotor_inertia.size() ? rotor_inertia[i] : 0.0});
  }
}

void ArmDynamics::place(const JointVector& q, Moving& out) const {
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    Spatial& body = out[i];
    const double coordinate = q[static_cast<Eigen::Index>(i)];
    origin += rotation * link.offset;
    rotation = (rotation * link.rotation).eval();
    const Vector3d axis = rotation * link.axis;
    if (link.turns) {
      rotation = (rotation * Eigen::AngleAxisd(coordinate, link.axis).toRotationMatrix()).eval();
      body.turn = axis;
      body.slide = origin.cross(axis);
    } else {
      origin += coordinate * axis;
      body.turn.setZero();
      body.slide = axis;
    }
    const Vector3d centre = origin + rotation * link.centre;
    body.mass = link.mass;
    body.moment = link.mass * centre;
    body.inertia.noalias() = rotation * link.inertia * rotation.transpose();
    body.inertia.noalias() -= body.moment * centre.transpose();
    body.inertia.diagonal().array() += body.moment.dot(centre);
  }
}

MotionEquation ArmDynamics::equation(const JointVector& q, const JointVector& rate) const {
  Moving bodies;
  place(q, bodies);
  const std::size_t count = links_.size();
  std::array<Vector3d, kinematics::kMaxJoints> forces, moments;
  Vector3d turning = Vector3d::Zero(), sliding = Vector3d::Zero();
  Vector3d turning_change = Vector3d::Zero(), sliding_change = -gravity_;
  for (std::size_t i = 0; i < count; ++i) {
    const Spatial& body = bodies[i];
    const double speed = rate[static_cast<Eigen::Index>(i)];
    turning += speed * body.turn;
    sliding += speed * body.slide;
    turning_change += speed * turning.cross(body.turn);
    sliding_change += speed * (turning.cross(body.slide) + sliding.cross(body.turn));
    const Vector3d momentum = body.momentum(turning, sliding);
    forces[i] = body.momentum(turning_change, sliding_change) + turning.cross(momentum);
    moments[i] = body.angular_momentum(turning_change, sliding_change) +
                 turning.cross(body.angular_momentum(turning, sliding)) + sliding.cross(momentum);
  }
  MotionEquation out{JointMatrix(joints(), joints()), JointVector(joints())};
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  for (std::size_t j = count; j-- > 0;) {
    Spatial& outboard = bodies[j];
    if (j + 1 < count) {
      outboard.mass += bodies[j + 1].mass;
      outboard.moment += bodies[j + 1].moment;
      outboard.inertia += bodies[j + 1].inertia;
    }
    force += forces[j];
    moment += moments[j];
    const auto column = static_cast<Eigen::Index>(j);
    out.bias[column] = outboard.turn.dot(moment) + outboard.slide.dot(force);
    const Vector3d momentum = outboard.momentum(outboard.turn, outboard.slide);
    const Vector3d angular = outboard.angular_momentum(outboard.turn, outboard.slide);
    for (std::size_t i = 0; i <= j; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double value = bodies[i].turn.dot(angular) + bodies[i].slide.dot(momentum);
      out.inertia(row, column) = out.inertia(column, row) = value;
    }
    out.inertia(column, column) += links_[j].rotor;
  }
  return out;
}

double ArmDynamics::energy_j(const JointVector& q, const JointVector& rate) const {
  Moving bodies;
  place(q, bodies);
  double energy = 0.5 * rate.dot(equation(q, rate).inertia * rate);
  for (std::size_t i = 0; i < links_.size(); ++i) energy -= gravity_.dot(bodies[i].moment);
  return energy;
}

kinematics::MassProperties held_box(double mass_kg, const std::vector<double>& size_m, const Vector3d& axis) {
  kinematics::MassProperties out;
  out.mass = mass_kg;
  if (size_m.size() != 3) return out;
  const Vector3d size(size_m[0], size_m[1], size_m[2]);
  out.centre = 0.5 * axis.cwiseAbs().dot(size) * axis;
  const Vector3d squares = size.cwiseAbs2();
  out.inertia.diagonal() = mass_kg / 12.0 * (Vector3d::Constant(squares.sum()) - squares);
  return out;
}

}  // namespace roci::sim::components
