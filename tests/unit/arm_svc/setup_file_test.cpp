#include "arm_svc/setup_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "arm_svc/motion.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using testing::HasSubstr;

std::string error_of(const ArmFiles& files) {
  const auto result = parse_setup(files);
  const auto* error = std::get_if<SetupError>(&result);
  return error == nullptr ? "no error" : error->message;
}

std::string error_of(const std::string& poses) {
  ArmFiles files = test::rover_files();
  files.poses_text = poses;
  return error_of(files);
}

TEST(SetupFile, ReadsTheMissionsFiles) {
  const ArmSetup setup = test::rover_setup();
  EXPECT_EQ(setup.arm.joints.size(), 5u);
  EXPECT_EQ(setup.collision.ground_z, -0.6);
  EXPECT_EQ(setup.motor.gravity.z(), -3.71);
  ASSERT_EQ(setup.poses[0].name, "stow");
  EXPECT_TRUE(std::holds_alternative<kinematics::JointVector>(setup.poses[0].where));
  EXPECT_EQ(model_version(setup), model_version(test::rover_setup()));
}

TEST(SetupFile, ReadsOrientationsAsRollPitchYaw) {
  ArmFiles files = test::rover_files();
  files.poses_text = "tip: scoop_tip\nposes:\n  p: {position: [1, 0, 0], rpy: [0, 1.5707963267948966, 0]}\n";
  const auto result = parse_setup(files);
  ASSERT_TRUE(std::holds_alternative<ArmSetup>(result));
  const auto& target = std::get<ToolTarget>(std::get<ArmSetup>(result).poses[0].where);
  ASSERT_TRUE(target.orientation);
  EXPECT_LT((*target.orientation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(SetupFile, ErrorsNameThePlaceAndTheRemedy) {
  EXPECT_THAT(error_of("poses: {}"), HasSubstr("poses.yaml:1:1: the file needs the key 'tip'"));
  EXPECT_THAT(error_of("tip: scoop_tip\npozes: {}"),
              HasSubstr("poses.yaml:2:1: the file has no key 'pozes'; it takes"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {joints: [1, 2]}"),
              HasSubstr("poses.yaml:3:15: pose 'a' gives 2 joint values; the arm has 5 joints"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {joints: [1, x, 0, 0, 0]}"),
              HasSubstr("must be a finite number"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {position: [1, 0, 0], approach: [0, 0, 0]}"),
              HasSubstr("must not be zero"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {approach: [0, 0, 1]}"),
              HasSubstr("needs either joints or"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {position: [1, 0, 0]}\n  a: {position: [1, 0, 0]}"),
              HasSubstr("poses.yaml:4:3: pose 'a' stands twice"));
  EXPECT_THAT(error_of("tip: scoop_tip\nmargin: 0\nposes: {}"),
              HasSubstr("poses.yaml:2:9: margin must be between"));
  EXPECT_THAT(error_of("tip: [\n"), HasSubstr("poses.yaml:"));
  EXPECT_THAT(error_of("tip: gripper\nposes: {}"), HasSubstr("arm.urdf: document: tip link 'gripper'"));
}

TEST(SetupFile, MutatedTextNeverCrashes) {
  const ArmFiles original = test::rover_files();
  std::mt19937_64 rng(30);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    ArmFiles files = original;
    std::string& text = files.poses_text;
    for (std::size_t e = 0; e <= rng() % 3 && !text.empty(); ++e) {
      const std::size_t at = rng() % text.size(), span = rng() % 12;
      switch (rng() % 4) {
        case 0:
          text[at] = static_cast<char>(rng() % 256);
          break;
        case 1:
          text.erase(at, span);
          break;
        case 2:
          text.insert(at, text.substr(rng() % text.size(), span));
          break;
        default:
          text.resize(at);
      }
    }
    const auto result = parse_setup(files);
    if (std::holds_alternative<SetupError>(result)) {
      ++refused;
      EXPECT_FALSE(std::get<SetupError>(result).message.empty());
    } else if (++read % 20 == 0) {
      EXPECT_NO_THROW(MotionModel(std::get<ArmSetup>(result)).motion("stow", "ready"));
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace roci::arm
