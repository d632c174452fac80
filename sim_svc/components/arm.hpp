// This is an arm between named poses: what its commands mean and what it reports, whatever its motions are; and the
// simple one (type `arm`), whose joints lag behind the trajectory.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_svc/components/arm_motion.hpp"
#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"

namespace roci::sim::components {

/// Holds the settings of an arm (README.md).
struct ArmSettings {
  ArmParameters motion;
  std::string planner = "arm_svc";     ///< the service that is asked for trajectories
  std::string stow_pose = "stow";      ///< the only pose in which the body may drive
  std::string stop_pose = "arm-here";  ///< its pose after a stop on the way
  std::string start_pose = "stow";
  std::vector<double> start_joints;  ///< rad or m, one per joint
};

/// Simulates an arm: move (from, to) asks for a trajectory between named poses, with the load that it believes to
/// hold, and tracks it; a stop on the way leaves it at the stop pose, and so does a motion that cannot be ended
/// (`arm-stalled`). It does not move while the body drives.
class Arm : public world::Component, public world::Manipulator, public world::BodyInterlock {
 public:
  Arm(ArmSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return {{"move", {"from", "to"}}}; }
  std::vector<world::StateForm> state_forms() const override { return {{"idle-pose", 1}, {"going-to", 1}}; }
  /// Returns idle-pose (pose) or going-to (pose).
  temporal::State state() const override;
  bool busy() const override { return target_.has_value(); }
  std::optional<std::string> pose() const override;
  world::Ending forbids_driving() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  bool waits_for_answer() const override { return busy() && !trace_; }
  world::Ending answer(const world::Answer&, temporal::Time now, world::Surroundings&) override;
  void settle(temporal::Time now, world::Body&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return trace_ ? trace_->peak_power_w : 0; }
  bool moves() const override { return next_change().has_value(); }
  /// Returns the joints as q0, q1, …
  std::vector<world::NamedNumber> numbers() const override;
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 protected:
  /// Works out the motion along the trajectory, which fits the arm, as it happens if nobody interrupts it.
  virtual ArmTrace track(const std::vector<world::JointTarget>&, temporal::Time now,
                         const world::ComponentSet&);
  const std::vector<double>& joints() const { return joints_; }
  const std::optional<ArmTrace>& trace() const { return trace_; }
  /// Replaces the running motion from now on.
  void retrace(ArmTrace trace) { trace_ = std::move(trace); }
  world::RandomStream& noise() { return noise_; }

 private:
  void rest(std::string pose);

  ArmSettings settings_;
  std::string pose_;
  std::vector<double> joints_;
  std::optional<std::string> target_;
  std::optional<ArmTrace> trace_;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
