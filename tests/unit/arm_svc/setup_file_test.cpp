#include "arm_svc/setup_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "arm_svc/motion.hpp"
#include "core/mission/entry.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using testing::HasSubstr;

class SetupFile : public testing::Test {
 protected:
  SetupFile() { std::filesystem::create_directories(folder_); }
  ~SetupFile() override { std::filesystem::remove_all(folder_); }

  ArmSetup load(const std::string& poses) {
    std::ofstream(folder_ / "poses.yaml", std::ios::binary) << poses;
    return load_setup(test::rover_folder() / "arm.urdf", folder_ / "poses.yaml");
  }

  std::string error_of(const std::string& poses) {
    try {
      load(poses);
      return "no error";
    } catch (const mission::FileError& error) {
      return error.what();
    }
  }

  const std::filesystem::path folder_ = testing::TempDir() + "arm_" + std::to_string(::getpid()) + "_" +
                                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(SetupFile, ReadsTheMissionsFiles) {
  const ArmSetup setup = test::rover_setup();
  EXPECT_EQ(setup.arm.joints.size(), 5u);
  EXPECT_EQ(setup.collision.ground_z, -0.6);
  EXPECT_EQ(setup.motor.gravity.z(), -3.71);
  ASSERT_EQ(setup.poses[0].name, "stow");
  EXPECT_TRUE(std::holds_alternative<kinematics::JointVector>(setup.poses[0].where));
  EXPECT_EQ(model_version(setup), model_version(test::rover_setup()));
}

TEST_F(SetupFile, ReadsOrientationsAsRollPitchYaw) {
  const ArmSetup setup =
      load("tip: scoop_tip\nposes:\n  p: {position: [1, 0, 0], rpy: [0, 1.5707963267948966, 0]}\n");
  const auto& target = std::get<ToolTarget>(setup.poses[0].where);
  ASSERT_TRUE(target.orientation);
  EXPECT_LT((*target.orientation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST_F(SetupFile, ErrorsNameThePlaceAndTheRemedy) {
  EXPECT_THAT(error_of("poses: {}"), HasSubstr("poses.yaml:1:1: 'tip' is missing"));
  EXPECT_THAT(error_of("tip: scoop_tip\npozes: {}"), HasSubstr("poses.yaml:2:1: unknown key 'pozes'"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {joints: [1, 2]}"),
              HasSubstr("poses.yaml:3:15: gives 2 numbers; the arm has 5"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {joints: [1, x, 0, 0, 0]}"),
              HasSubstr("poses.yaml:3:19: "));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {position: [1, 0, 0], approach: [0, 0, 0]}"),
              HasSubstr("must not be zero"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {approach: [0, 0, 1]}"),
              HasSubstr("needs either joints or"));
  EXPECT_THAT(error_of("tip: scoop_tip\nposes:\n  a: {position: [1, 0, 0]}\n  a: {position: [1, 0, 0]}"),
              HasSubstr("poses.yaml:4:6: pose 'a' stands twice"));
  EXPECT_THAT(error_of("tip: scoop_tip\nmargin: 0\nposes: {}"),
              HasSubstr("poses.yaml:2:9: must be between 0.001"));
  EXPECT_THAT(error_of("tip: ["), HasSubstr("not valid YAML"));
  EXPECT_THAT(error_of("tip: gripper\nposes: {}"), HasSubstr("arm.urdf: document: tip link 'gripper'"));
  EXPECT_THROW(load_setup(folder_ / "none.urdf", test::rover_folder() / "poses.yaml"), mission::FileError);
}

TEST_F(SetupFile, MutatedTextNeverCrashes) {
  const std::string original = test::rover_file("poses.yaml");
  std::mt19937_64 rng(30);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::string text = original;
    for (std::size_t edit = 0; edit <= rng() % 3 && !text.empty(); ++edit) {
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
    try {
      ArmSetup setup = load(text);
      setup.search_iterations = std::min(setup.search_iterations, 50u);
      if (++read % 20 == 0) {
        EXPECT_NO_THROW(MotionModel(setup).motion({"stow"}, {"ready"}));
      }
    } catch (const mission::FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace roci::arm
