// A motion between places has a trajectory, a duration and an energy, or the reason why there is none.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "arm_svc/payload.hpp"
#include "arm_svc/places.hpp"
#include "arm_svc/trajectory.hpp"

namespace roci::arm {

/// Holds a motion with its duration (s) and energy (J), or the reason why there is none.
struct Motion {
  MotionStatus status = MotionStatus::found;
  std::string detail;     ///< It names the pose, link or joint; it is empty when found.
  Trajectory trajectory;  ///< It has no segments when both ends are the same place.
  double duration_s = 0;
  double energy_j = 0;
  /// Says that there is no such motion at all. Where it is false and nothing was found, more effort may find one.
  bool proved = false;
};

/// Asks for a motion with a payload. An effort of n spends n times the setup's budgets; it finds the motion that
/// a smaller effort finds, if that finds one.
struct MotionQuery {
  Place from;
  Place to;
  Payload payload = {};
  unsigned effort = 1;
};

/// Holds what a motion takes at least, worked out without a search; or a proof that there is none, or why nothing
/// can be said.
struct MotionBound {
  MotionStatus status = MotionStatus::found;
  std::string detail;
  bool proved = false;
  double duration_s = 0;
  double energy_j = 0;
};

/// An arm model is immutable: the same call gives the same answer, whatever was asked before.
class MotionModel {
 public:
  explicit MotionModel(ArmSetup setup);

  ResolvedPlace resolve(const Place& place, unsigned effort = 1) const {
    return places_.resolve(place, effort);
  }

  /// Plans the motion. `cancelled` is asked often; it may be empty.
  Motion motion(const Place& from, const Place& to, const std::function<bool()>& cancelled = {}) const;
  Motion plan(const MotionQuery& query, const std::function<bool()>& cancelled = {}) const;
  /// Plans between two places that this model has resolved. No module stands in the way where the motion starts
  /// and ends.
  Motion plan(const ResolvedPlace& from, const ResolvedPlace& to, const Payload& payload, unsigned effort,
              const std::function<bool()>& cancelled) const;

  /// Bounds the motion from below by the limits of the joints: never above what plan() finds, whatever the
  /// effort.
  MotionBound bound(const ResolvedPlace& from, const ResolvedPlace& to, const Payload& payload) const;

  const ArmSetup& setup() const { return *setup_; }
  /// Returns the poses in the order of the setup.
  const std::vector<ResolvedPlace>& poses() const { return places_.poses(); }
  std::uint64_t version() const { return version_; }
  /// Says whether modules stand about, so that it counts by which names the ends of a motion go.
  bool has_modules() const { return !places_.modules().empty(); }

 private:
  Motion between(const kinematics::Arm& arm, const CollisionChecker& full, const CollisionChecker& close,
                 const ResolvedPlace& from, const ResolvedPlace& to, unsigned effort,
                 const std::function<bool()>& cancelled) const;

  std::shared_ptr<const ArmSetup> setup_;
  CollisionChecker checker_;
  CollisionChecker close_checker_;  // for ends that an imprecise arm left within the margin
  std::uint64_t version_;
  Places places_;
};

}  // namespace roci::arm
