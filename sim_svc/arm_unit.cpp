#include "sim_svc/arm_unit.hpp"

namespace roci::sim {

ArmUnit::ArmUnit(std::string pose, std::vector<double> joints, const RobotNames& names, std::uint64_t seed)
    : pose_(std::move(pose)), stop_pose_(names.stop_pose), joints_(std::move(joints)), noise_(seed, "arm") {}

State ArmUnit::state() const { return target_ ? State{"going-to", {*target_}} : State{"idle-pose", {pose_}}; }

Ending ArmUnit::begin(const Task& task, Time, Surroundings& around) {
  const std::string& from = task.arguments.at("from");
  if (from != pose_) return Failure{"wrong-pose", "the arm is at '" + pose_ + "', not at '" + from + "'"};
  if (around.view.gripper.name == "working") {
    return Failure{"gripper-busy", "the gripper is working; wait for it"};
  }
  if (around.view.nav.name != "idle-at") return Failure{"driving", "the rover drives; stop it first"};
  target_ = task.arguments.at("to");
  around.out.push_back(MotionWanted{task.key, from, joints_, *target_});
  return std::nullopt;
}

Ending ArmUnit::follow(const std::vector<JointTarget>& targets, Time now, Surroundings& around) {
  if (std::string fault = motion_fault(joints_, targets); !fault.empty()) {
    return Failure{"bad-trajectory", std::move(fault)};
  }
  trace_ = simulate_arm(around.robot.arm, now, joints_, targets, noise_);
  return std::nullopt;
}

std::optional<Time> ArmUnit::next_change() const {
  if (!trace_) return std::nullopt;
  return trace_->end();
}

Ending ArmUnit::finish(Surroundings&) {
  joints_ = trace_->samples.back().joints;
  rest(*target_);
  return std::nullopt;
}

void ArmUnit::halt(Time now) {
  const bool moved = trace_.has_value();
  settle(now);
  rest(moved ? stop_pose_ : pose_);
}

void ArmUnit::settle(Time now) {
  if (trace_) joints_ = trace_->at(now).joints;
}

double ArmUnit::energy_j(Time from, Time to) const {
  return trace_ ? trace_->at(to).energy_j - trace_->at(from).energy_j : 0;
}

void ArmUnit::rest(std::string pose) {
  pose_ = std::move(pose);
  target_.reset();
  trace_.reset();
}

}  // namespace roci::sim
