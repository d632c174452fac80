// Places become joint values once: the poses of a mission, positions of the tool, and wherever the arm stands.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arm_svc/collision.hpp"
#include "arm_svc/motion_status.hpp"
#include "arm_svc/setup.hpp"
#include "core/kinematics/reach.hpp"

namespace roci::arm {

/// A motion starts or ends at a place: wherever the joints put the arm if they are given, else a pose of the
/// mission by name, else (no pose has this name) where the tool's origin is at a position (m, base frame).
struct Place {
  std::string name;
  std::optional<kinematics::JointVector> joints = std::nullopt;
  std::optional<Eigen::Vector3d> position = std::nullopt;
};

/// Holds a place as joint values, or the reason why it has none.
struct ResolvedPlace {
  std::string name;
  /// Holds found, unknown_pose, unreachable, unsolved or in_collision.
  MotionStatus status = MotionStatus::found;
  std::string detail;
  kinematics::JointVector joints;
  /// Says that no joint values whatsoever are at this place; where it is false, more effort may find some.
  bool proved = false;
  bool by_joints = false;  ///< The joint values were given, not chosen.
};

/// A search spends so many times the setup's budget at most.
inline constexpr unsigned kMostEffort = 16;

/// Holds the box that stands where a pose says.
struct Module {
  std::string pose;
  kinematics::CollisionShape shape;  ///< Stands in the base frame; its link is "module at POSE".
};

/// Resolves places. A pose or position of the tool becomes the free solution that is quickest to reach from the
/// first pose given by joint values (the middle of the limits if there is none); one where a module stands becomes,
/// if it can, one that is free with that module in the tool as well. It is immutable.
class Places {
 public:
  explicit Places(std::shared_ptr<const ArmSetup> setup);

  /// Joints off a limit by no more than sensor noise (0.01 rad or m) are clamped to it. `effort` multiplies the
  /// starts of the inverse kinematics where one start set finds nothing: what a smaller effort finds stays.
  ResolvedPlace resolve(const Place& place, unsigned effort = 1) const;

  /// Returns the poses in the order of the setup, resolved with an effort of 1.
  const std::vector<ResolvedPlace>& poses() const { return poses_; }
  const std::vector<Module>& modules() const { return modules_; }

 private:
  ResolvedPlace resolve(const NamedPose& pose, unsigned effort) const;
  ResolvedPlace resolve_joints(const NamedPose& pose, const kinematics::JointVector& joints) const;
  ResolvedPlace resolve_target(const NamedPose& pose, const ToolTarget& target, int starts) const;
  ResolvedPlace resolve_stand(const Place& place) const;
  std::vector<kinematics::JointVector> candidates(const NamedPose& pose, const ToolTarget& target,
                                                  int starts) const;
  std::optional<Contact> contact(const NamedPose& pose, const kinematics::JointVector& q) const;
  bool free_when_carrying(const Eigen::Vector3d& module_size, const kinematics::JointVector& q) const;

  std::shared_ptr<const ArmSetup> setup_;
  std::vector<Module> modules_;
  CollisionChecker checker_;        // the modules are its obstacles
  CollisionChecker close_checker_;  // without them, for where an imprecise arm stands within the margin
  kinematics::ReachBound reach_;
  kinematics::JointVector reference_;
  std::vector<ResolvedPlace> poses_;
  std::map<std::string, std::size_t> index_;
};

/// Returns the rules with the margin that ends have which an imprecise arm left within the full one.
CollisionRules with_close_margin(CollisionRules rules);

/// Returns "WHAT: LINK touches LINK".
std::string touching(const std::string& what, const Contact& contact);

}  // namespace roci::arm
