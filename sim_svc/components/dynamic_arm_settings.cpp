#include "sim_svc/components/dynamic_arm_settings.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include "core/kinematics/urdf.hpp"
#include "core/words/nearest_word.hpp"
#include "sim_svc/components/arm_settings.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

constexpr double kSlowest = 0.05;  // for a bandwidth, rad/s, and what else is divided by

Eigen::Vector3d vector_of(const Entry& entry) {
  const auto items = entry.items();
  if (items.size() != 3) entry.fail("expected three numbers such as [0, 0, -9.81]; correct the list");
  return {items[0].number(), items[1].number(), items[2].number()};
}

// The arm is the one that the mission's arm planner has: model, tip and limits.
std::shared_ptr<const kinematics::Arm> load_arm(const Entry& model, const Entry& poses) {
  const std::filesystem::path file = model.resolve(model.text());
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) model.fail(file.string() + " cannot be read; check that the file exists");
  kinematics::UrdfOptions options{poses.at("tip").text()};
  options.time_to_speed_s = poses.number_or("time_to_speed", options.time_to_speed_s);
  auto arm = kinematics::parse_urdf(text.str(), file.string(), options);
  if (const auto* error = std::get_if<kinematics::UrdfError>(&arm))
    throw mission::FileError(to_string(*error));
  return std::make_shared<const kinematics::Arm>(std::get<kinematics::Arm>(std::move(arm)));
}

double share(Settings& in, std::string_view key, double fallback, double least, double most) {
  const double value = in.number(key, fallback, least);
  if (value > most)
    in.find(key)->fail("'" + std::string(key) + "' must be at most " + std::to_string(most) +
                       "; correct the number");
  return value;
}

JointsWear read_wear(Settings& in, const kinematics::Arm& arm) {
  const auto count = static_cast<Eigen::Index>(arm.joints.size());
  JointsWear out{kinematics::JointVector::Zero(count), kinematics::JointVector::Zero(count)};
  const auto name = in.find("degrading_joint");
  const double growth = in.number("friction_growth", 0);
  if (!name) {
    if (const auto given = in.find("friction_growth"); given && growth > 0)
      given->fail("no joint is named whose friction grows; add degrading_joint");
    return out;
  }
  std::vector<std::string> known;
  for (Eigen::Index i = 0; i < count; ++i) {
    const kinematics::Joint& joint = arm.joints[static_cast<std::size_t>(i)];
    known.push_back(joint.name);
    if (joint.name != name->text()) continue;
    out.growth[i] = growth * joint.limits.effort;
    return out;
  }
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
  name->fail("the arm has no joint '" + name->text() + "'; known: " + list +
             words::did_you_mean(name->text(), known));
}

}  // namespace

DynamicArmSettings read_dynamic_arm_settings(Settings& in) {
  DynamicArmSettings out;
  DrivenArmParameters& p = out.drive;
  p.bandwidth = share(in, "bandwidth", p.bandwidth, kSlowest, 10);
  p.motor_strength = share(in, "motor_strength", p.motor_strength, kSlowest, 10);
  p.rotor_share = share(in, "rotor_share", p.rotor_share, 0.01, 1);
  p.continuous_load = share(in, "continuous_load", p.continuous_load, kSlowest, 0.99);
  p.follow_rad = in.number("follow_rad", p.follow_rad, 1e-4);
  p.settled_rad = in.number("settled_rad", p.settled_rad, 1e-4);
  p.settled_rad_s = in.number("settled_rad_s", p.settled_rad_s, 1e-4);
  p.settle_s = in.number("settle_s", p.settle_s);
  p.stall_s = in.number("stall_s", p.stall_s, 1);
  p.friction_noise = in.number("friction_noise", p.friction_noise);
  p.electronics_w = in.number("electronics_w", p.electronics_w);
  p.gear_efficiency = share(in, "gear_efficiency", p.gear_efficiency, kSlowest, 1);
  p.copper_loss_w = in.number("copper_loss_w", p.copper_loss_w);
  if (const auto gravity = in.find("gravity")) p.gravity = vector_of(*gravity);
  const auto own_model = in.find("model");
  const Entry model = own_model ? *own_model : in.mission().at("arm").at("model");
  const Entry poses_file = poses_file_of(in);
  const Entry poses = Entry::load(poses_file.resolve(poses_file.text()));
  p.arm = load_arm(model, poses);
  if (const auto axis = poses.find("tool_axis")) p.tool_axis = vector_of(*axis).stableNormalized();
  out.wear = read_wear(in, *p.arm);
  out.common = read_common_arm_settings(in);
  if (out.common.start_joints.size() != p.arm->joints.size()) {
    const Entry where = in.start() ? *in.start() : in.find("start_pose").value_or(in.component());
    where.fail("pose '" + out.common.start_pose + "' has " + std::to_string(out.common.start_joints.size()) +
               " joints, the arm has " + std::to_string(p.arm->joints.size()) + "; correct " +
               poses.file().string());
  }
  return out;
}

}  // namespace roci::sim::components
