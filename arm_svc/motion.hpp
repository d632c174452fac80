// A motion between named poses has a trajectory, a duration and an energy, or the reason why there is none.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arm_svc/collision.hpp"
#include "arm_svc/path_search.hpp"
#include "arm_svc/setup.hpp"
#include "arm_svc/trajectory.hpp"

namespace roci::arm {

/// Says whether there is a motion, or why not.
enum class MotionStatus {
  found,
  unknown_pose,  ///< The mission's data have no pose of that name.
  unreachable,   ///< The joint values lie beyond the limits, or none put the tool there.
  in_collision,  ///< The pose itself touches something.
  no_path,       ///< The search budget shows no way between the two.
  overloaded,    ///< The motors would have to exert more than their effort limits.
  cancelled,
};

/// Returns the name above.
std::string_view name_of(MotionStatus status);

/// Is a motion with its duration (s) and energy (J), or the reason why there is none.
struct Motion {
  MotionStatus status = MotionStatus::found;
  std::string detail;     ///< It names the pose, link or joint; it is empty when found.
  Trajectory trajectory;  ///< It has no segments when both ends are the same place.
  double duration_s = 0;
  double energy_j = 0;
};

/// A motion starts or ends at a place: a pose of the mission by name or, if joints are given, wherever they
/// put the arm.
struct Place {
  std::string name;
  std::optional<kinematics::JointVector> joints = std::nullopt;
};

/// Is a place as joint values, or the reason why it has none.
struct ResolvedPlace {
  std::string name;
  MotionStatus status = MotionStatus::found;  ///< Is found, unknown_pose, unreachable or in_collision.
  std::string detail;
  kinematics::JointVector joints;
};

/// An arm model is immutable: the same call gives the same answer, whatever was asked before.
class MotionModel {
 public:
  /// Resolves all poses. A pose given by tool position becomes the free solution that is quickest to reach
  /// from the first pose given by joint values (the middle of the limits if there is none).
  explicit MotionModel(ArmSetup setup);

  /// Joints off a limit by no more than sensor noise (0.01 rad or m) are clamped to it.
  ResolvedPlace resolve(const Place& place) const;

  /// Plans the motion. `cancelled` is asked often; it may be empty.
  Motion motion(const Place& from, const Place& to, const std::function<bool()>& cancelled = {}) const;

  const ArmSetup& setup() const { return setup_; }
  /// Returns the poses in the order of the setup.
  const std::vector<ResolvedPlace>& poses() const { return poses_; }
  std::uint64_t version() const { return version_; }

 private:
  ResolvedPlace resolve(const NamedPose& pose, const kinematics::JointVector& reference) const;

  ArmSetup setup_;
  CollisionChecker checker_;
  CollisionChecker close_checker_;  // for ends that an imprecise arm left within the margin
  std::uint64_t version_;
  std::vector<ResolvedPlace> poses_;
};

}  // namespace roci::arm
