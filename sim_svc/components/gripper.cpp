#include "sim_svc/components/gripper.hpp"

#include <algorithm>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

Ending arm_elsewhere(const world::ComponentSet& components, const std::string& pose) {
  const auto* arm = components.find<world::Manipulator>();
  if (!arm || arm->pose() == pose) return std::nullopt;
  return Failure{"wrong-pose", "the arm is not at pose '" + pose + "'; move it there first"};
}

Ending body_elsewhere(const world::ComponentSet& components, const std::string& place) {
  const auto* wheels = components.find<world::Mobility>();
  if (!wheels || wheels->place() == place) return std::nullopt;
  return Failure{"wrong-place", "the robot does not stand at '" + place + "'; drive there first"};
}

}  // namespace

Gripper::Gripper(GripperSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), noise_(std::move(noise)) {}

State Gripper::state() const {
  if (work_) return {"working", {}};
  return held_ ? State{"holding", {*held_}} : State{"empty", {}};
}

Ending Gripper::at_work() const {
  if (!work_) return std::nullopt;
  return Failure{"gripper-busy", "the gripper is working; wait for it"};
}

Ending Gripper::begin(const world::Task& task, Time now, Surroundings& around) {
  const bool pick = task.command == "pick";
  const std::string& place = task.arguments.at("place");
  if (Ending refused = body_elsewhere(around.components, place)) return refused;
  const std::string& pose = pick ? settings_.pick_pose : settings_.drop_pose;
  if (Ending refused = arm_elsewhere(around.components, pose)) return refused;
  if (Ending refused = pick ? begin_pick(task, around.environment) : begin_drop(task)) return refused;
  const double nominal = pick ? settings_.pick_s : settings_.drop_s;
  const double duration = nominal * noise_.factor(settings_.duration_noise);
  work_ = Work{pick, task.arguments.at("sample"), place, now + temporal::seconds(duration)};
  return std::nullopt;
}

Ending Gripper::begin_pick(const world::Task& task, world::Environment& environment) {
  if (held_) return Failure{"not-empty", "the gripper holds '" + *held_ + "'; drop it first"};
  const std::string& sample = task.arguments.at("sample");
  const std::string& place = task.arguments.at("place");
  if (environment.samples.try_emplace(sample, place).first->second != place) {
    return Failure{"no-sample", "'" + sample + "' does not lie at '" + place + "'"};
  }
  samples_.try_emplace(sample, State{"in-place", {place}});
  return std::nullopt;
}

Ending Gripper::begin_drop(const world::Task& task) const {
  const std::string& sample = task.arguments.at("sample");
  if (held_ == sample) return std::nullopt;
  return Failure{"not-held", "the gripper does not hold '" + sample + "'; pick it first"};
}

std::optional<Time> Gripper::next_change() const {
  if (!work_) return std::nullopt;
  return work_->end;
}

Ending Gripper::finish(Surroundings& around) {
  const Work done = *std::exchange(work_, std::nullopt);
  std::string& lies_at = around.environment.samples[done.sample];
  if (!done.pick) {
    around.effects.push_back({"drop", done.sample});
    held_.reset();
    samples_[done.sample] = {"dropped", {done.place}};
    lies_at = done.place;
    return std::nullopt;
  }
  if (lies_at != done.place) return Failure{"no-sample", "somebody else took '" + done.sample + "'"};
  around.effects.push_back({"pick", done.sample});
  held_ = done.sample;
  samples_[done.sample] = {"held", {}};
  lies_at.clear();
  return std::nullopt;
}

double Gripper::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

// A sample that it holds is one that it has touched.
world::Memory Gripper::memory() const { return {samples_.begin(), samples_.end()}; }

void Gripper::restore(const world::Memory& memory) {
  for (const auto& [sample, value] : memory) {
    const auto* state = std::get_if<State>(&value);
    if (!state) continue;
    samples_[sample] = *state;
    if (state->name == "held") held_ = sample;
  }
}

std::vector<world::NamedState> Gripper::states() const {
  std::vector<world::NamedState> out;
  for (const auto& [sample, state] : samples_) out.push_back({"sample." + sample, state});
  return out;
}

}  // namespace roci::sim::components
