#pragma once
#include <string>
#include <vector>

#include "sim_svc/arm_motion.hpp"
#include "sim_svc/surroundings.hpp"

namespace roci::sim {

/// The arm: move (from, to) asks for a trajectory between named poses and tracks it; a stop on the way leaves
/// it at `arm-here`.
class ArmUnit {
 public:
  ArmUnit(std::string pose, std::vector<double> joints, const RobotNames&, std::uint64_t seed);

  static std::string_view name() { return "arm"; }
  static std::vector<CommandForm> commands() { return {{"move", {"from", "to"}}}; }

  const std::vector<double>& joints() const { return joints_; }
  State state() const;
  bool busy() const { return target_.has_value(); }
  bool waits_for_motion() const { return busy() && !trace_; }

  Ending begin(const Task&, Time now, Surroundings&);
  /// Starts the joints.
  Ending follow(const std::vector<JointTarget>&, Time now, Surroundings&);
  std::optional<Time> next_change() const;
  /// At next_change(): the motion ends at the pose.
  Ending finish(Surroundings&);
  void halt(Time now);
  /// Brings joints() up to `now`.
  void settle(Time now);

  double energy_j(Time from, Time to) const;
  double peak_power_w() const { return trace_ ? trace_->peak_power_w : 0; }

 private:
  void rest(std::string pose);

  std::string pose_;
  std::string stop_pose_;
  std::vector<double> joints_;
  std::optional<std::string> target_;
  std::optional<ArmTrace> trace_;
  RandomStream noise_;
};

}  // namespace roci::sim
