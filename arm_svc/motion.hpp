// Motions between named poses: trajectory, duration and energy, or the reason why there is none.
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

enum class MotionStatus {
  found,
  unknown_pose,  // no pose of that name in the mission's data
  unreachable,   // joint values beyond the limits, or no joint values put the tool there
  in_collision,  // the pose itself touches something
  no_path,       // no way between the two within the search budget
  overloaded,    // the motors would have to exert more than their effort limits
  cancelled,
};

std::string_view name_of(MotionStatus status);

struct Motion {
  MotionStatus status = MotionStatus::found;
  std::string detail;     // which pose, link or joint; empty when found
  Trajectory trajectory;  // no segments when from and to are the same place
  double duration_s = 0;
  double energy_j = 0;
};

// A pose of the mission as joint values, or why it has none.
struct ResolvedPose {
  std::string name;
  MotionStatus status = MotionStatus::found;  // found, unreachable or in_collision
  std::string detail;
  kinematics::JointVector joints;
};

// An immutable arm model. The same call gives the same answer, whatever was asked before.
class MotionModel {
 public:
  // Resolves all poses. A pose given by tool position becomes the free solution that is quickest to reach
  // from the first pose given by joint values (the middle of the limits if there is none).
  explicit MotionModel(ArmSetup setup);

  using Cancelled = std::function<bool()>;
  Motion motion(std::string_view from, std::string_view to, const Cancelled& cancelled = {}) const;

  // From where the arm stands; the joint values may be off a limit by sensor noise (0.01 rad or m).
  Motion motion(const kinematics::JointVector& from, std::string_view to,
                const Cancelled& cancelled = {}) const;

  const ArmSetup& setup() const { return setup_; }
  const std::vector<ResolvedPose>& poses() const { return poses_; }
  std::uint64_t version() const { return version_; }

 private:
  ResolvedPose resolve(const NamedPose& pose, const kinematics::JointVector& reference) const;
  const ResolvedPose* find(std::string_view name) const;
  Motion between(const kinematics::JointVector& from, const kinematics::JointVector& to,
                 const Cancelled& cancelled) const;

  ArmSetup setup_;
  CollisionChecker checker_;
  std::uint64_t version_;
  std::vector<ResolvedPose> poses_;
};

}  // namespace roci::arm
