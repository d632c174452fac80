// Arms for the tests: the planetary mission's own, and chains of 4 to 7 joints in the shape of well-known
// ones.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "arm_svc/setup.hpp"
#include "arm_svc/setup_file.hpp"

namespace roci::arm::test {

ArmFiles rover_files();
ArmSetup rover_setup();

struct NamedArm {
  std::string name;
  kinematics::Arm arm;
};

// 4 joints with a slide, 5 (the rover's), 6 with a wrist of three offset axes, 7 with a spherical wrist.
std::vector<NamedArm> all_arms();

}  // namespace roci::arm::test
