// The rigid-body dynamics of an arm that the simulator moves: M(q) q̈ + h(q, q̇) = τ, by the composite-rigid-body
// algorithm (M) and the recursive Newton-Euler algorithm (h), both with spatial vectors in base coordinates, where the
// inertias of bodies simply add up (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6).
#pragma once

#include <array>
#include <vector>

#include "core/kinematics/arm.hpp"

namespace roci::sim::components {

/// Holds a square matrix with a row for each joint.
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kinematics::kMaxJoints, kinematics::kMaxJoints>;

/// Holds the equation of motion at one state: inertia · q̈ + bias = τ.
struct MotionEquation {
  JointMatrix inertia;           ///< kg·m², kg·m or kg
  kinematics::JointVector bias;  ///< of gravity, centrifugal and Coriolis forces, N·m or N
};

/// Describes an arm with its load under gravity. It is immutable; friction is not its business.
class ArmDynamics {
 public:
  /// `load` is given in the frame of the tool. `rotor_inertia` is that of each joint's motor as the joint feels it; it
  /// adds to the diagonal of the inertia.
  ArmDynamics(const kinematics::Arm&, const Eigen::Vector3d& gravity,
              const kinematics::MassProperties& load = {}, const std::vector<double>& rotor_inertia = {});

  /// Both vectors have one value for each joint: rad or m, and per s.
  MotionEquation equation(const kinematics::JointVector& q, const kinematics::JointVector& rate) const;
  /// Returns the kinetic energy and that of height in the field of gravity, J; its zero lies in the base's origin.
  double energy_j(const kinematics::JointVector& q, const kinematics::JointVector& rate) const;
  Eigen::Index joints() const { return static_cast<Eigen::Index>(links_.size()); }

 private:
  // A joint with the body that it moves.
  struct Link {
    bool turns = true;
    Eigen::Matrix3d rotation;  // of the joint frame at 0, in the previous body
    Eigen::Vector3d offset;
    Eigen::Vector3d axis;
    double mass = 0;
    Eigen::Vector3d centre;
    Eigen::Matrix3d inertia;
    double rotor = 0;
  };
  struct Spatial;
  using Moving = std::array<Spatial, kinematics::kMaxJoints>;
  void place(const kinematics::JointVector& q, Moving& out) const;

  std::vector<Link> links_;
  Eigen::Vector3d gravity_;
};

/// Returns a box of even density that the tool holds in the middle of a face: its centre lies half an edge ahead along
/// `axis`, a unit vector of the tool. `size_m` empty: a point at the tool.
kinematics::MassProperties held_box(double mass_kg, const std::vector<double>& size_m,
                                    const Eigen::Vector3d& axis);

}  // namespace roci::sim::components
