#include "sim_svc/components/drive_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using temporal::seconds;
using temporal::Time;
using temporal::to_seconds;
using world::RandomStream;

namespace {

constexpr Time kStart{123456};

DriveTrace drive(const world::Ground& ground, const world::Pose& from, const std::vector<terrain::Point>& way,
                 std::uint64_t seed = 1, const DriveParameters& parameters = {}) {
  world::RandomStream noise(seed, "drive");
  return simulate_drive(ground, parameters, kStart, from, way, 0, noise);
}

double duration_s(const DriveTrace& trace) { return to_seconds(trace.end - trace.start); }

TEST(Drive, ArrivesExactlyWithinATenthOfNominalTimeOnFlatGround) {
  const world::Ground flat{flat_site(), {}};
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const DriveTrace trace = drive(flat, {20, 20, 0}, {{60, 20}, {60, 60}, {100, 60}}, seed);
    ASSERT_EQ(trace.outcome, DriveEnd::arrived);
    EXPECT_EQ(trace.samples.back().pose.x, 100);
    EXPECT_EQ(trace.samples.back().pose.y, 60);
    const double nominal = 120 / 0.1 + M_PI / 0.2;
    EXPECT_NEAR(duration_s(trace), nominal, 0.1 * nominal) << "seed " << seed;
  }
}

TEST(Drive, AnotherSeedTakesAnotherTime) {
  const world::Ground flat{flat_site(), {}};
  EXPECT_EQ(drive(flat, {}, {{50, 0}}, 3).end, drive(flat, {}, {{50, 0}}, 3).end);
  EXPECT_NE(drive(flat, {}, {{50, 0}}, 3).end, drive(flat, {}, {{50, 0}}, 4).end);
}

TEST(Drive, NeverFasterThanItsWheels) {
  const world::Ground flat{flat_site(), {}};
  const DriveTrace trace = drive(flat, {20, 20, 1}, {{60, 50}, {30, 90}});
  for (std::size_t i = 1; i < trace.samples.size(); ++i) {
    const world::Pose& a = trace.samples[i - 1].pose;
    const world::Pose& b = trace.samples[i].pose;
    EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), 0.105 * 1.05 * 0.1 + 1e-12);
    EXPECT_GE(trace.samples[i].energy_j, trace.samples[i - 1].energy_j);
  }
}

TEST(Drive, UphillIsSlowerAndDearerThanDownhill) {
  const world::Ground ramp{ramp_site(0.2), {}};
  const DriveTrace up = drive(ramp, {20, 20, 0}, {{60, 20}});
  const DriveTrace down = drive(ramp, {60, 20, M_PI}, {{20, 20}});
  EXPECT_GT(duration_s(up), 1.05 * duration_s(down));
  EXPECT_GT(up.samples.back().energy_j, 1.5 * down.samples.back().energy_j);
}

TEST(Drive, TooSteepGroundHoldsItFast) {
  const DriveTrace trace = drive({ramp_site(0.7), {}}, {20, 20, 0}, {{60, 20}});
  EXPECT_EQ(trace.outcome, DriveEnd::stuck);
  EXPECT_NEAR(duration_s(trace), 90, 5);
}

TEST(Drive, StopsBeforeAHiddenRock) {
  const world::Ground ground{flat_site(), {{40, 20.5, 1}}};
  const DriveTrace trace = drive(ground, {20, 20, 0}, {{60, 20}});
  ASSERT_EQ(trace.outcome, DriveEnd::blocked);
  EXPECT_EQ(trace.seen_rock, 0u);
  const world::Pose& pose = trace.samples.back().pose;
  const double edge = std::hypot(pose.x - 40, pose.y - 20.5) - 1;
  EXPECT_GT(edge, 0.6 + 2.5);
  EXPECT_LT(edge, 0.6 + 3.0 + 0.02);
}

TEST(Drive, PassesARockBesideTheWay) {
  const world::Ground ground{flat_site(), {{40, 22, 1}}};
  EXPECT_EQ(drive(ground, {20, 20, 0}, {{60, 20}}).outcome, DriveEnd::arrived);
}

TEST(Drive, APathThroughARockOfTheMapEndsInACollision) {
  const terrain::Site flat = *flat_site();
  terrain::SiteLayers layers = flat.layers();
  layers.occupancy[flat.grid().index(flat.grid().cell_of({40, 20}))] = terrain::Occupancy::occupied;
  const world::Ground ground{std::make_shared<terrain::Site>(flat.grid(), layers), {}};
  const DriveTrace trace = drive(ground, {20, 20.5, 0}, {{60, 20.5}});
  EXPECT_EQ(trace.outcome, DriveEnd::collision);
  EXPECT_NEAR(trace.samples.back().pose.x, 40, 0.1);
}

TEST(Drive, SamplesBetweenStepsLieBetweenThem) {
  const DriveTrace trace = drive({flat_site(), {}}, {20, 20, 0}, {{30, 25}});
  const DriveSample a = trace.samples[300];
  const DriveSample b = trace.samples[301];
  const DriveSample middle = trace.at(kStart + 300 * kDriveStep + kDriveStep / 2);
  EXPECT_NEAR(middle.pose.x, (a.pose.x + b.pose.x) / 2, 1e-9);
  EXPECT_NEAR(middle.energy_j, (a.energy_j + b.energy_j) / 2, 1e-9);
  EXPECT_EQ(trace.at(kStart - seconds(1)).pose, trace.samples.front().pose);
  EXPECT_EQ(trace.at(trace.end + seconds(1)).pose, trace.samples.back().pose);
}

TEST(Drive, ADriveToWhereItStandsIsOverAtOnce) {
  const DriveTrace trace = drive({flat_site(), {}}, {20, 20, 0}, {{20, 20}});
  EXPECT_EQ(trace.outcome, DriveEnd::arrived);
  EXPECT_EQ(trace.end, kStart);
}

}  // namespace
}  // namespace roci::sim::components
