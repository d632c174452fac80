#include "tests/unit/arm_svc/arms.hpp"

#include <fstream>
#include <numbers>
#include <sstream>

#include "arm_svc/setup_file.hpp"

namespace roci::arm::test {
namespace {

using kinematics::Arm;
using kinematics::Joint;
using kinematics::JointType;

Joint joint(JointType type, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double lower,
            double upper) {
  Joint j;
  j.type = type;
  j.origin.translation() = origin;
  j.axis = axis;
  j.limits = {lower, upper, 1.0, 2.0, 50.0};
  return j;
}

Joint turn(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double range) {
  return joint(JointType::revolute, origin, axis, -range, range);
}

Arm arm_of(std::vector<Joint> joints, const Eigen::Vector3d& tool) {
  Arm arm;
  arm.bodies.resize(joints.size() + 1);
  arm.joints = std::move(joints);
  arm.tool.translation() = tool;
  return arm;
}

const Eigen::Vector3d X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY(),
                      Z = Eigen::Vector3d::UnitZ();

}  // namespace

std::filesystem::path rover_folder() { return ROCI_SOURCE_DIR "/missions/planetary/arm"; }

std::string rover_file(const std::string& name) {
  std::ifstream file(rover_folder() / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

ArmSetup rover_setup() { return load_setup(rover_folder() / "arm.urdf", rover_folder() / "poses.yaml"); }

ArmSetup rail_setup() {
  const std::filesystem::path folder = ROCI_SOURCE_DIR "/tests/unit/arm_svc/rail";
  return load_setup(folder / "arm.urdf", folder / "poses.yaml");
}

std::vector<NamedArm> all_arms() {
  constexpr double kPi = std::numbers::pi;
  const Arm four = arm_of({turn({0, 0, 0.2}, Z, 2.6), turn({0.4, 0, 0}, Z, 2.4),
                           joint(JointType::prismatic, {0.35, 0, 0}, -Z, 0.0, 0.3), turn({0, 0, 0}, Z, 3.0)},
                          {0, 0, -0.1});
  const Arm six = arm_of(
      {turn({0, 0, 0.09}, Z, 2 * kPi), turn({0, 0.14, 0}, Y, 2 * kPi), turn({0, -0.12, 0.425}, Y, kPi),
       turn({0, 0, 0.39}, Y, 2 * kPi), turn({0, 0.095, 0}, Z, 2 * kPi), turn({0, 0, 0.095}, Y, 2 * kPi)},
      {0, 0.08, 0});
  const Arm seven =
      arm_of({turn({0, 0, 0.16}, Z, 2.97), turn({0, 0, 0.2}, Y, 2.09), turn({0, 0, 0.2}, Z, 2.97),
              turn({0, 0, 0.22}, -Y, 2.09), turn({0, 0, 0.18}, Z, 2.97), turn({0, 0, 0.22}, Y, 2.09),
              turn({0, 0, 0.08}, Z, 3.05)},
             {0.02, 0, 0.06});
  return {{"four_with_slide", four},
          {"rover_five", rover_setup().arm},
          {"six_offset_wrist", six},
          {"seven", seven}};
}

}  // namespace roci::arm::test
