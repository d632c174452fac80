// An arm is a rigid serial chain as plain values: it says what a URDF chain says, with fixed joints folded
// into the bodies they hold.
//
// Body 0 is the base, which stands still; body i+1 is moved by joint i. All lengths are in m, angles in rad,
// masses in kg; a joint coordinate is rad (revolute) or m (prismatic) about or along the joint's axis.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <variant>
#include <vector>

namespace roci::kinematics {

inline constexpr int kMinJoints = 4;
inline constexpr int kMaxJoints = 7;

/// Holds one value per joint, base first.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;

/// Says whether a joint turns about its axis or slides along it.
enum class JointType { revolute, prismatic };

/// Bounds position, speed, acceleration, effort and jerk of one joint.
struct JointLimits {
  double lower = 0;         ///< rad or m
  double upper = 0;         ///< rad or m
  double velocity = 0;      ///< rad/s or m/s, > 0
  double acceleration = 0;  ///< rad/s² or m/s², > 0
  double effort = 0;        ///< N·m or N, > 0
  double jerk = 0;          ///< rad/s³ or m/s³; 0 stands for none
};

/// Describes one movable joint with its place on the previous body.
struct Joint {
  std::string name;
  JointType type = JointType::revolute;
  /// Holds the joint frame at coordinate 0, in the previous body.
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector in the joint frame
  JointLimits limits;
  double friction = 0;  ///< Coulomb friction, N·m or N
  double damping = 0;   ///< viscous friction, N·m·s/rad or N·s/m
};

/// Describes a sphere centred on the origin; the radius is in m.
struct Sphere {
  double radius = 0;
};

/// Holds all points within `radius` of a segment of `length` on the z axis, centred on the origin.
struct Capsule {
  double radius = 0;
  double length = 0;
};

/// Describes a box centred on the origin, with its sides along the axes.
struct Box {
  /// Holds full edge lengths in m.
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
};

/// Holds a shape that is fixed to a body.
struct CollisionShape {
  std::string link;                                        ///< URDF link that the shape came from
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the shape in the body's frame
  std::variant<Sphere, Capsule, Box> form;
};

/// Holds mass (kg), centre and inertia of a rigid body.
struct MassProperties {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centre of mass in the body's frame, m
  /// Holds the inertia about the centre of mass, in the axes of the body's frame, kg·m².
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Describes a rigid body of the arm with all that is fixed to it.
struct Body {
  std::string name;  ///< first URDF link of the body
  MassProperties mass;
  std::vector<CollisionShape> shapes;
};

/// Describes the whole arm; joint i joins body i+1 to body i.
struct Arm {
  std::string name;
  std::vector<Joint> joints;                               ///< kMinJoints..kMaxJoints
  std::vector<Body> bodies;                                ///< joints.size() + 1
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  ///< pose of the tip link in the last body's frame
};

/// Returns whether the coordinates lie within the position limits, up to `tolerance`; a vector of another
/// size or with a NaN does not.
bool within_limits(const Arm& arm, const JointVector& q, double tolerance = 0.0);

/// Returns the coordinates moved into the position limits. `q` has one value per joint.
JointVector clamp_to_limits(const Arm& arm, const JointVector& q);

}  // namespace roci::kinematics
