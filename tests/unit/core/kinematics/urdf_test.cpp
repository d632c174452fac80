#include "core/kinematics/urdf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include "core/kinematics/forward.hpp"

namespace roci::kinematics {
namespace {

using testing::HasSubstr;

const UrdfOptions kScoop{"scoop_tip", 0.5};

std::string rover_arm_text() {
  std::ifstream file(ROCI_SOURCE_DIR "/missions/planetary/arm/arm.urdf");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// The rover arm's text with the first `from` after `anchor` replaced.
std::string edited(const std::string& anchor, const std::string& from, const std::string& to) {
  std::string text = rover_arm_text();
  const std::size_t start = text.find(anchor);
  const std::size_t at = text.find(from, start);
  EXPECT_NE(start, std::string::npos) << anchor;
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

int line_of(const std::string& text, const std::string& what) {
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(what)), '\n'));
}

std::string error_of(const std::string& text, const UrdfOptions& options = kScoop) {
  const auto result = parse_urdf(text, "arm.urdf", options);
  const auto* error = std::get_if<UrdfError>(&result);
  return error == nullptr ? "no error" : to_string(*error);
}

TEST(Urdf, ReadsTheRoverArm) {
  const auto result = parse_urdf(rover_arm_text(), "arm.urdf", kScoop);
  ASSERT_TRUE(std::holds_alternative<Arm>(result)) << to_string(std::get<UrdfError>(result));
  const Arm& arm = std::get<Arm>(result);
  ASSERT_EQ(arm.joints.size(), 5u);
  ASSERT_EQ(arm.bodies.size(), 6u);
  EXPECT_EQ(arm.joints[1].name, "shoulder");
  EXPECT_EQ(arm.joints[1].limits.lower, -2.8);
  EXPECT_EQ(arm.joints[1].limits.acceleration, 0.35);
  EXPECT_EQ(arm.joints[1].friction, 0.8);
  EXPECT_EQ(arm.bodies[0].shapes.size(), 5u) << "deck, two wheel boxes, and by fixed joints mast and mount";
  EXPECT_TRUE(std::holds_alternative<Capsule>(arm.bodies[2].shapes[0].form));
  EXPECT_DOUBLE_EQ(arm.bodies[2].mass.mass, 2.0);
  const JointVector zero = JointVector::Zero(5);
  const Eigen::Vector3d stretched(0.42 + 0.50 + 0.45 + 0.13 + 0.12, -0.10 + 0.12, 0.08 + 0.10);
  EXPECT_LT((tool_pose(arm, zero).translation() - stretched).norm(), 1e-12);
}

TEST(Urdf, AccelerationDefaultsToTheTimeToSpeed) {
  const std::string text = edited("name=\"elbow\"", "acceleration=\"0.50\"", "");
  const auto result = parse_urdf(text, "arm.urdf", {"scoop_tip", 2.0});
  ASSERT_TRUE(std::holds_alternative<Arm>(result));
  EXPECT_DOUBLE_EQ(std::get<Arm>(result).joints[2].limits.acceleration, 0.35 / 2.0);
}

TEST(Urdf, JerkIsGivenOrFollowsFromTheTimeToAccelerationOrIsNotBounded) {
  const std::string text = edited("name=\"elbow\"", "effort=\"30\"", "effort=\"30\" jerk=\"2.5\"");
  const auto plain = parse_urdf(text, "arm.urdf", kScoop),
             timed = parse_urdf(text, "arm.urdf", {"scoop_tip", 0.5, 0.2});
  ASSERT_TRUE(std::holds_alternative<Arm>(plain) && std::holds_alternative<Arm>(timed));
  EXPECT_EQ(std::get<Arm>(plain).joints[2].limits.jerk, 2.5);
  EXPECT_EQ(std::get<Arm>(plain).joints[1].limits.jerk, 0);
  EXPECT_EQ(std::get<Arm>(timed).joints[2].limits.jerk, 2.5);
  EXPECT_DOUBLE_EQ(std::get<Arm>(timed).joints[1].limits.jerk, 0.35 / 0.2);
}

TEST(Urdf, FixedJointFoldsMassIntoTheBodyThatHoldsIt) {
  const std::string payload =
      "<link name=\"scoop_tip\"><inertial><mass value=\"0.45\"/>"
      "<inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>";
  const auto result = parse_urdf(edited("", "<link name=\"scoop_tip\"/>", payload), "arm.urdf", kScoop);
  ASSERT_TRUE(std::holds_alternative<Arm>(result));
  const MassProperties& mass = std::get<Arm>(result).bodies.back().mass;
  EXPECT_DOUBLE_EQ(mass.mass, 0.9);
  EXPECT_NEAR(mass.centre.x(), (0.07 + 0.12) / 2, 1e-12);
  EXPECT_NEAR(mass.inertia(1, 1), 0.0006 + 0.9 * 0.025 * 0.025, 1e-12);
  EXPECT_NEAR(mass.inertia(0, 0), 0.0004, 1e-12);
}

TEST(UrdfError, NamesFileLineElementAndRemedy) {
  const std::string no_limits = edited(
      "name=\"elbow\"",
      "<limit lower=\"-2.9\" upper=\"2.9\" velocity=\"0.35\" acceleration=\"0.50\" effort=\"30\"/>", "");
  const std::string place = "arm.urdf:" + std::to_string(line_of(no_limits, "<joint name=\"elbow\"")) + ": ";
  EXPECT_THAT(error_of(no_limits), HasSubstr(place + "joint 'elbow': has no limits; add <limit"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "xyz=\"0 1 0\"", "xyz=\"0 0 0\"")),
              HasSubstr(place + "joint 'elbow': the axis must not be zero"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "lower=\"-2.9\"", "lower=\"3.9\"")),
              HasSubstr(place + "joint 'elbow': the lower limit must be below the upper"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "<parent link=\"upper_arm\"", "<parent link=\"upper\"")),
              HasSubstr("link 'upper' is not in the document"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "<parent link=\"upper_arm\"", "<parent link=\"scoop\"")),
              HasSubstr("closes a cycle through link"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "<child link=\"forearm\"", "<child link=\"turret\"")),
              HasSubstr(place + "joint 'elbow': link 'turret' is the child of two joints"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "velocity=\"0.35\"", "velocity=\"fast\"")),
              HasSubstr("limit: attribute 'velocity' must be 1 finite number, not 'fast'"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "type=\"revolute\"", "type=\"floating\"")),
              HasSubstr("type 'floating' is not one of"));
  EXPECT_THAT(error_of(edited("name=\"wrist\"", "<cylinder radius=\"0.03\" length=\"0.08\"/>",
                              "<mesh filename=\"wrist.stl\"/>")),
              HasSubstr("not mesh"));
  EXPECT_THAT(error_of(edited("name=\"scoop\"", "<mass value=\"0.45\"/>", "")),
              HasSubstr("inertial: needs a <mass value="));
  EXPECT_THAT(
      error_of(edited("name=\"scoop\"", "ixx=\"0.0004\"", "ixx=\"-0.0004\"")),
      HasSubstr("inertia: the moments of inertia must not be negative, about no axis (the least is -0.0004"));
  const std::string massless = edited("name=\"scoop\"", "<mass value=\"0.45\"/>", "<mass value=\"0\"/>");
  EXPECT_THAT(error_of(massless),
              HasSubstr("arm.urdf:" + std::to_string(line_of(massless, "<joint name=\"tool_roll\"")) +
                        ": joint 'tool_roll': moves no mass; give link 'scoop'"));
  for (const char* speed : {"1e-9", "0", "-1", "1e300"})
    EXPECT_THAT(
        error_of(edited("name=\"elbow\"", "velocity=\"0.35\"", "velocity=\"" + std::string(speed) + "\"")),
        HasSubstr("limit: attribute 'velocity' must be between 0.0001 and 10000 rad/s or m/s"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "acceleration=\"0.50\"", "acceleration=\"1e-5\"")),
              HasSubstr("attribute 'acceleration' must be between 0.0001 and 10000 rad/s²"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "effort=\"30\"", "effort=\"30\" jerk=\"0\"")),
              HasSubstr("attribute 'jerk' must be between 0.0001 and 10000"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "effort=\"30\"", "effort=\"1e-9\"")),
              HasSubstr("attribute 'effort' must be between 0.001 and 1e+07 N·m or N"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "upper=\"2.9\"", "upper=\"2.9e9\"")),
              HasSubstr("attribute 'upper' must be between -1000 and 1000 rad or m"));
  EXPECT_THAT(error_of("<robot name=\"x\"><link name=\"a\"></robot>"),
              HasSubstr("arm.urdf:1: document: not XML"));
  EXPECT_THAT(error_of("<sdf/>"), HasSubstr("root element is <robot>"));
  EXPECT_THAT(error_of(""), HasSubstr("not XML"));
}

TEST(UrdfError, UnknownTipBranchAndJointCount) {
  EXPECT_THAT(error_of(rover_arm_text(), {"gripper", 0.5}),
              HasSubstr("tip link 'gripper' is not in the document"));
  EXPECT_THAT(error_of(rover_arm_text(), {"mast", 0.5}),
              HasSubstr("joint 'azimuth': branches off the chain to 'mast'"));
  EXPECT_THAT(error_of(edited("name=\"elbow\"", "type=\"revolute\"", "type=\"fixed\"")),
              HasSubstr("no error"));
  std::string three = edited("name=\"elbow\"", "type=\"revolute\"", "type=\"fixed\"");
  three.replace(three.find("type=\"revolute\""), 15, "type=\"fixed\"");
  EXPECT_THAT(error_of(three), HasSubstr("has 3 movable joints; an arm has 4 to 7"));
}

// A mutated document gives an arm or an error with a message; nothing crashes or hangs.
TEST(UrdfError, MutatedTextNeverCrashes) {
  const std::string original = rover_arm_text();
  std::mt19937_64 rng(3);
  int arms = 0, errors = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::string text = original;
    const int edits = 1 + static_cast<int>(rng() % 4);
    for (int e = 0; e < edits && !text.empty(); ++e) {
      const std::size_t at = rng() % text.size(), span = rng() % 40;
      switch (rng() % 5) {
        case 0:
          text[at] = static_cast<char>(rng() % 256);
          break;
        case 1:
          text.erase(at, span);
          break;
        case 2:
          text.insert(at, text.substr(rng() % text.size(), span));
          break;
        case 3:
          text.resize(at);
          break;
        default:
          text.replace(at, span, "-1e999 nan \"<");
      }
    }
    const auto result = parse_urdf(text, "arm.urdf", kScoop);
    if (const auto* arm = std::get_if<Arm>(&result)) {
      ++arms;
      const JointVector q = clamp_to_limits(*arm, JointVector::Zero(static_cast<long>(arm->joints.size())));
      EXPECT_TRUE(tool_pose(*arm, q).matrix().allFinite());
    } else {
      ++errors;
      EXPECT_FALSE(std::get<UrdfError>(result).message.empty());
    }
  }
  EXPECT_GT(arms, 0);
  EXPECT_GT(errors, 0);
}

}  // namespace
}  // namespace roci::kinematics
