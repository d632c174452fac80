// Arms for the tests: the planetary mission's own, and chains of 4 to 7 joints in the shape of well-known
// ones.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "arm_svc/setup.hpp"

namespace roci::arm::test {

std::filesystem::path rover_folder();  // with arm.urdf and poses.yaml
std::string rover_file(const std::string& name);
ArmSetup rover_setup();
// Six turning joints on a rail, slots with modules on both sides, no gravity, jerk limits.
ArmSetup rail_setup();

struct NamedArm {
  std::string name;
  kinematics::Arm arm;
};

// 4 joints with a slide, 5 (the rover's), 6 with a wrist of three offset axes, 7 with a spherical wrist.
std::vector<NamedArm> all_arms();

}  // namespace roci::arm::test
