#include "sim_svc/components/arm_settings.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

constexpr double kPositive = 1e-3;  // for what is divided by

// A start pose has no inverse kinematics yet: it must be given by joint coordinates.
std::vector<double> joints_of(const Entry& pose, const Entry& poses_file) {
  const Entry poses = Entry::load(poses_file.resolve(poses_file.text())).at("poses");
  const auto entry = poses.find(pose.text());
  if (entry) entry->allow_only({"joints", "position", "approach", "rpy"});
  const auto joints = entry ? entry->find("joints") : std::nullopt;
  if (!joints) {
    pose.fail("no pose '" + pose.text() + "' with joints stands in " + poses.file().string() +
              "; start at a pose that is given by joints");
  }
  std::vector<double> out;
  for (const Entry& joint : joints->items()) out.push_back(joint.number());
  return out;
}

}  // namespace

Entry poses_file_of(Settings& in) {
  const auto own = in.find("poses");
  return own ? *own : in.mission().at("arm").at("poses");
}

ArmSettings read_common_arm_settings(Settings& in) {
  ArmSettings out;
  out.planner = in.text("planner", out.planner);
  out.stow_pose = in.text("stow_pose", out.stow_pose);
  out.stop_pose = in.text("stop_pose", out.stop_pose);
  const auto start_pose = in.find("start_pose");
  const std::optional<Entry> start = in.start() ? in.start() : start_pose;
  if (!start)
    in.component().fail("the pose at the start is not given; add start_pose, or the scenario's start");
  out.start_pose = start->text();
  out.start_joints = joints_of(*start, poses_file_of(in));
  return out;
}

ArmSettings read_arm_settings(Settings& in) {
  ArmParameters motion;
  motion.joint_lag_s = in.number("joint_lag_s", motion.joint_lag_s, kPositive);
  motion.speed_noise = in.number("speed_noise", motion.speed_noise);
  motion.settled_rad = in.number("settled_rad", motion.settled_rad, 1e-6);
  motion.base_power_w = in.number("base_power_w", motion.base_power_w);
  motion.power_per_speed_w = in.number("power_per_speed_w", motion.power_per_speed_w);
  in.find("poses");
  ArmSettings out = read_common_arm_settings(in);
  out.motion = motion;
  return out;
}

}  // namespace roci::sim::components
