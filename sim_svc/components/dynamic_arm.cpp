#include "sim_svc/components/dynamic_arm.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/words/nearest_word.hpp"

namespace roci::sim::components {

using temporal::Time;
using world::JointWear;

namespace {

constexpr double kLeastFriction = 0.2;  // of a joint's own, whatever the noise

}  // namespace

DynamicArm::DynamicArm(DynamicArmSettings settings, world::RandomStream noise)
    : Arm(std::move(settings.common), std::move(noise)),
      drive_(std::move(settings.drive)),
      wear_(std::move(settings.wear)) {}

ArmTrace DynamicArm::track(const std::vector<world::JointTarget>& targets, Time now,
                           const world::ComponentSet& components) {
  const auto* holder = components.find<world::PayloadHolder>();
  const world::Payload load = (holder ? holder->payload() : std::nullopt).value_or(world::Payload{});
  const double friction = std::max(kLeastFriction, 1 + drive_.friction_noise * noise().normal());
  motion_.emplace(drive_, joints(), wear_, targets, held_box(load.told_kg, load.size_m, drive_.tool_axis),
                  held_box(load.true_kg, load.size_m, drive_.tool_axis), friction);
  return motion_->trace(now);
}

std::size_t DynamicArm::moment_at(Time now) const {
  return static_cast<std::size_t>(std::max<std::int64_t>(0, (now - trace()->start) / kArmStep));
}

std::optional<Eigen::Index> DynamicArm::joint_named(const std::string& name) const {
  const auto& all = drive_.arm->joints;
  const auto found = std::ranges::find(all, name, &kinematics::Joint::name);
  if (found == all.end()) return std::nullopt;
  return found - all.begin();
}

std::optional<std::string> DynamicArm::spared_from(const world::Mishap& what) const {
  const auto* wear = std::get_if<JointWear>(&what);
  if (!wear) return std::nullopt;
  if (joint_named(wear->joint)) return std::string();
  std::vector<std::string> known;
  for (const kinematics::Joint& joint : drive_.arm->joints) known.push_back(joint.name);
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
  return "the arm has no joint '" + wear->joint + "'; known: " + list +
         words::did_you_mean(wear->joint, known);
}

void DynamicArm::suffer(const world::Mishap& what, Time now, world::Surroundings&) {
  const auto& wear = std::get<JointWear>(what);
  const Eigen::Index joint = *joint_named(wear.joint);
  const double effort = drive_.arm->joints[static_cast<std::size_t>(joint)].limits.effort;
  if (motion_) wear_ = motion_->wear_at(moment_at(now));
  wear_.friction[joint] = std::max(wear_.friction[joint], wear.friction * effort);
  wear_.growth[joint] = std::max(wear_.growth[joint], wear.growth * effort);
  if (!motion_) return;
  motion_->go_on_from(moment_at(now), wear_);
  retrace(motion_->trace(trace()->start));
}

world::Ending DynamicArm::finish(world::Surroundings& around) {
  wear_ = motion_->wear_at(std::numeric_limits<std::size_t>::max());
  motion_.reset();
  return Arm::finish(around);
}

void DynamicArm::halt(Time now, world::Surroundings& around) {
  if (motion_) wear_ = motion_->wear_at(moment_at(now));
  motion_.reset();
  Arm::halt(now, around);
}

world::Memory DynamicArm::memory() const {
  world::Memory out = Arm::memory();
  for (Eigen::Index i = 0; i < wear_.friction.size(); ++i) {
    out["friction" + std::to_string(i)] = wear_.friction[i];
    out["growth" + std::to_string(i)] = wear_.growth[i];
  }
  return out;
}

void DynamicArm::restore(const world::Memory& memory) {
  Arm::restore(memory);
  const auto take = [&](const std::string& name, double& value) {
    const auto kept = memory.find(name);
    const auto* number = kept == memory.end() ? nullptr : std::get_if<double>(&kept->second);
    if (number) value = std::max(0.0, *number);
  };
  for (Eigen::Index i = 0; i < wear_.friction.size(); ++i) {
    take("friction" + std::to_string(i), wear_.friction[i]);
    take("growth" + std::to_string(i), wear_.growth[i]);
  }
}

}  // namespace roci::sim::components
