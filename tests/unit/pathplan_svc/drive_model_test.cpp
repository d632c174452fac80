#include "pathplan_svc/drive_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace roci::pathplan {
namespace {

// 100 kg at 4 m/s², mu 0.25, half the electrical work at the wheels, 20 W of electronics, 0.2 m/s.
DriveModel round_figures() {
  DriveModel drive;
  drive.speed = 0.2;
  drive.slip_per_grade = 1.0;
  drive.max_slip = 0.5;
  drive.rough_slowdown = 0.5;
  drive.turn_rate = 0.1;
  drive.mass = 100;
  drive.gravity = 4;
  drive.rolling_resistance = 0.25;
  drive.drive_efficiency = 0.5;
  drive.idle_power = 20;
  drive.turn_power = 30;
  return drive;
}

TEST(DriveModel, LevelGround) {
  const Pace pace = round_figures().pace(0, 0);
  EXPECT_NEAR(pace.time, 5, 1e-12);                               // 1 / 0.2
  EXPECT_NEAR(pace.energy, 100 * 4 * 0.25 / 0.5 + 20 * 5, 1e-9);  // 200 J rolling, 100 J electronics
}

TEST(DriveModel, UphillSlipsAndLifts) {
  const Pace pace = round_figures().pace(0.2, 0);
  const double seconds = std::sqrt(1.04) / (0.2 * 0.8);
  EXPECT_NEAR(pace.time, seconds, 1e-12);
  EXPECT_NEAR(pace.energy, 100 * 4 * 0.45 / 0.8 / 0.5 + 20 * seconds, 1e-9);
}

TEST(DriveModel, DownhillBrakingGivesNothingBack) {
  const Pace gentle = round_figures().pace(-0.1, 0);
  EXPECT_NEAR(gentle.energy, 100 * 4 * 0.15 / 0.5 + 20 * gentle.time, 1e-9);
  const Pace steep = round_figures().pace(-0.3, 0);
  EXPECT_NEAR(steep.time, std::sqrt(1.09) / 0.2, 1e-12);
  EXPECT_NEAR(steep.energy, 20 * steep.time, 1e-9);
}

TEST(DriveModel, SlipIsLimitedAndRoughGroundSlows) {
  EXPECT_NEAR(round_figures().pace(3.0, 0).time, std::sqrt(10.0) / (0.2 * 0.5), 1e-9);
  EXPECT_NEAR(round_figures().pace(0, 1).time, 10, 1e-12);
  EXPECT_NEAR(round_figures().pace(0, 0.5).time, 5 / 0.75, 1e-12);
}

TEST(DriveModel, TurnsOfEitherSignCostTheSame) {
  EXPECT_NEAR(round_figures().turn_time(0.5), 5, 1e-12);
  EXPECT_NEAR(round_figures().turn_time(-0.5), 5, 1e-12);
  EXPECT_NEAR(round_figures().turn_energy(0.5), 5 * 50, 1e-12);
}

TEST(DriveModel, NothingIsFasterThanTheFastest) {
  const DriveModel drive = round_figures();
  for (double grade = -1; grade <= 1; grade += 0.01) {
    for (double roughness = 0; roughness <= 1; roughness += 0.1) {
      EXPECT_GE(drive.pace(grade, roughness).time, drive.fastest());
    }
  }
}

}  // namespace
}  // namespace roci::pathplan
