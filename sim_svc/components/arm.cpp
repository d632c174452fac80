#include "sim_svc/components/arm.hpp"

#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

constexpr double kMilliradian = 1e-3;

}  // namespace

Arm::Arm(ArmSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)),
      pose_(settings_.start_pose),
      joints_(settings_.start_joints),
      noise_(std::move(noise)) {}

State Arm::state() const { return target_ ? State{"going-to", {*target_}} : State{"idle-pose", {pose_}}; }

std::optional<std::string> Arm::pose() const {
  if (target_) return std::nullopt;
  return pose_;
}

Ending Arm::forbids_driving() const {
  if (pose() == settings_.stow_pose) return std::nullopt;
  return Failure{"arm-not-stowed",
                 "the arm is not at pose '" + settings_.stow_pose + "'; move it there first"};
}

Ending Arm::begin(const world::Task& task, Time, Surroundings& around) {
  const std::string& from = task.arguments.at("from");
  if (from != pose_) return Failure{"wrong-pose", "the arm is at '" + pose_ + "', not at '" + from + "'"};
  for (const auto* other : around.components.all<world::ManipulatorInterlock>()) {
    if (Ending forbidden = other->forbids_reaching()) return forbidden;
  }
  const auto* wheels = around.components.find<world::Mobility>();
  if (wheels && !wheels->place()) return Failure{"driving", "the robot drives; stop it first"};
  target_ = task.arguments.at("to");
  world::MotionWanted wanted{task.key, settings_.planner, around.robot, from, joints_, *target_};
  const auto* holder = around.components.find<world::PayloadHolder>();
  if (const auto load = holder ? holder->payload() : std::nullopt) {
    wanted.payload_kg = load->told_kg;
    wanted.payload_size_m = load->size_m;
  }
  around.out.push_back(std::move(wanted));
  return std::nullopt;
}

Ending Arm::answer(const world::Answer& answer, Time now, Surroundings& around) {
  const auto* trajectory = std::get_if<world::Trajectory>(&answer);
  if (!trajectory) return Failure{"bad-trajectory", "the answer is no trajectory"};
  if (std::string fault = motion_fault(joints_, trajectory->targets); !fault.empty()) {
    return Failure{"bad-trajectory", std::move(fault)};
  }
  trace_ = track(trajectory->targets, now, around.components);
  around.effects.push_back({"motion", *target_});
  return std::nullopt;
}

ArmTrace Arm::track(const std::vector<world::JointTarget>& targets, Time now, const world::ComponentSet&) {
  return simulate_arm(settings_.motion, now, joints_, targets, noise_);
}

std::optional<Time> Arm::next_change() const {
  if (!trace_) return std::nullopt;
  return trace_->end();
}

Ending Arm::finish(Surroundings&) {
  joints_ = trace_->samples.back().joints;
  if (!trace_->stalled.empty()) {
    Failure stalled{"arm-stalled", trace_->stalled};
    rest(settings_.stop_pose);
    return stalled;
  }
  rest(*target_);
  return std::nullopt;
}

void Arm::halt(Time now, Surroundings& around) {
  const bool moved = trace_.has_value();
  settle(now, around.body);
  rest(moved ? settings_.stop_pose : pose_);
}

void Arm::settle(Time now, world::Body&) {
  if (trace_) joints_ = trace_->at(now).joints;
}

double Arm::energy_j(Time from, Time to) const {
  return trace_ ? trace_->at(to).energy_j - trace_->at(from).energy_j : 0;
}

std::vector<world::NamedNumber> Arm::numbers() const {
  std::vector<world::NamedNumber> out;
  for (const double joint : joints_) out.push_back({"q" + std::to_string(out.size()), joint, kMilliradian});
  return out;
}

world::Memory Arm::memory() const {
  world::Memory out{{"pose", State{"idle-pose", {trace_ ? settings_.stop_pose : pose_}}}};
  for (const world::NamedNumber& joint : numbers()) out[joint.name] = joint.value;
  return out;
}

void Arm::restore(const world::Memory& memory) {
  const auto pose = memory.find("pose");
  const auto* state = pose == memory.end() ? nullptr : std::get_if<State>(&pose->second);
  if (!state || state->arguments.size() != 1) return;
  pose_ = state->arguments.front();
  for (const world::NamedNumber& joint : numbers()) {
    const auto kept = memory.find(joint.name);
    const auto* position = kept == memory.end() ? nullptr : std::get_if<double>(&kept->second);
    if (position) joints_[std::stoul(joint.name.substr(1))] = *position;
  }
}

void Arm::rest(std::string pose) {
  pose_ = std::move(pose);
  target_.reset();
  trace_.reset();
}

}  // namespace roci::sim::components
