#include "sim_svc/gripper.hpp"

#include <algorithm>

namespace roci::sim {
namespace {

Ending arm_elsewhere(const RobotView& view, const std::string& pose) {
  if (view.arm == State{"idle-pose", {pose}}) return std::nullopt;
  return Failure{"wrong-pose", "the arm is not at pose '" + pose + "'; move it there first"};
}

Ending rover_elsewhere(const RobotView& view, const std::string& place) {
  if (view.nav == State{"idle-at", {place}}) return std::nullopt;
  return Failure{"wrong-place", "the rover does not stand at '" + place + "'; drive there first"};
}

}  // namespace

Gripper::Gripper(std::uint64_t seed) : noise_(seed, "gripper") {}

State Gripper::state() const {
  if (work_) return {"working", {}};
  return held_ ? State{"holding", {*held_}} : State{"empty", {}};
}

Ending Gripper::begin(const Task& task, Time now, Surroundings& around) {
  const bool pick = task.command == "pick";
  const std::string& place = task.arguments.at("place");
  const RobotNames& names = around.robot.names;
  if (Ending refused = rover_elsewhere(around.view, place)) return refused;
  if (Ending refused = arm_elsewhere(around.view, pick ? names.pick_pose : names.drop_pose)) return refused;
  if (Ending refused = pick ? begin_pick(task) : begin_drop(task)) return refused;
  const GripperParameters& gripper = around.robot.gripper;
  const double nominal = pick ? gripper.pick_s : gripper.drop_s;
  const double duration = nominal * std::max(0.5, 1 + gripper.duration_noise * noise_.normal());
  work_ = Work{pick, task.arguments.at("sample"), place, now + seconds(duration)};
  power_w_ = gripper.power_w;
  return std::nullopt;
}

Ending Gripper::begin_pick(const Task& task) {
  if (held_) return Failure{"not-empty", "the gripper holds '" + *held_ + "'; drop it first"};
  const std::string& sample = task.arguments.at("sample");
  const std::string& place = task.arguments.at("place");
  const State& lies = samples_.try_emplace(sample, State{"in-place", {place}}).first->second;
  if (lies.arguments != std::vector<std::string>{place}) {
    return Failure{"no-sample", "'" + sample + "' does not lie at '" + place + "'"};
  }
  return std::nullopt;
}

Ending Gripper::begin_drop(const Task& task) const {
  const std::string& sample = task.arguments.at("sample");
  if (held_ == sample) return std::nullopt;
  return Failure{"not-held", "the gripper does not hold '" + sample + "'; pick it first"};
}

std::optional<Time> Gripper::next_change() const {
  if (!work_) return std::nullopt;
  return work_->end;
}

Ending Gripper::finish(Surroundings&) {
  if (work_->pick) {
    held_ = work_->sample;
    samples_[work_->sample] = {"held", {}};
  } else {
    held_.reset();
    samples_[work_->sample] = {"dropped", {work_->place}};
  }
  work_.reset();
  return std::nullopt;
}

}  // namespace roci::sim
