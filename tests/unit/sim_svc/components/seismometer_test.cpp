#include "sim_svc/components/seismometer.hpp"

#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using world::Tier;

namespace {

SeismometerSettings seismometer() {
  SeismometerSettings out;
  out.duration_noise = 0;
  out.products = {{"summary", Tier::decisional, 1e4}, {"quakes", Tier::mandatory, 6e6}};
  return out;
}

world::WorldSetup station(const SeismometerSettings& settings) {
  world::RobotSetup robot;
  robot.name = "lander";
  robot.power = world::PowerSetup{{1e8, 0}, 5e7};
  robot.data_bytes = 1e12;
  robot.components = {part<Seismometer>("seismometer", "seismometer", settings)};
  return {{}, {}, {robot}};
}

// Records for so long and returns the run.
Flight recorded(double for_s, const SeismometerSettings& settings = seismometer(), std::uint64_t seed = 1) {
  Flight run(station(settings), seed);
  run.command(seconds(0), execute("start", "seismometer", "start"));
  run.command(seconds(for_s), execute("park", "seismometer", "park"));
  run.advance(seconds(for_s + 601));
  return run;
}

double number(const Flight& run, const std::string& activity, const std::string& name) {
  return std::get<double>(run.last_ack(activity)->status.results.values.at(name));
}

TEST(Seismometer, IsParkedUntilItIsLevelAndRecordsUntilItIsParked) {
  Flight run(station(seismometer()));
  run.command(seconds(0), execute("start", "seismometer", "start"));
  run.advance(seconds(599));
  EXPECT_EQ(run.state("lander.seismometer"), (State{"parked", {}}));
  run.advance(seconds(600));
  EXPECT_EQ(run.state("lander.seismometer"), (State{"recording", {}}));
  run.command(seconds(1000), execute("again", "seismometer", "start"));
  EXPECT_EQ(run.time_of("again"), seconds(1000));
  EXPECT_EQ(run.state("lander.seismometer"), (State{"recording", {}}));
  run.command(seconds(2000), execute("park", "seismometer", "park"));
  run.advance(seconds(2599));
  EXPECT_EQ(run.state("lander.seismometer"), (State{"recording", {}}));
  run.advance(seconds(2600));
  EXPECT_EQ(run.state("lander.seismometer"), (State{"parked", {}}));
  EXPECT_EQ(number(run, "park", "recorded_s"), 2000);
}

TEST(Seismometer, DrawsItsPowerAllTheWhile) {
  Flight run = recorded(86400);
  run.advance(seconds(90000));
  EXPECT_NEAR(last_number(run.said, "lander.battery"), 5e7 - 5 * (600 + 600 + 86400), 60 * 10);
}

TEST(Seismometer, ItsDataGrowWithTimeAndQuakes) {
  const Flight run = recorded(10 * 86400.0);
  const double quakes = number(run, "park", "quakes");
  EXPECT_NEAR(quakes, 200, 45) << "20 a day";
  ASSERT_EQ(products_in(run.said).size(), 2u);
  EXPECT_EQ(products_in(run.said)[0].kind, "summary") << "the more urgent one first";
  EXPECT_EQ(products_in(run.said)[1].kind, "quakes");
  EXPECT_EQ(products_in(run.said)[1].source, "park");
  const double days = 10;
  EXPECT_NEAR(static_cast<double>(products_in(run.said)[1].bytes), 6e6 * (0.3 * days + 0.7 * quakes / 20), 1);
  EXPECT_LT(products_in(recorded(86400).said)[1].bytes, products_in(run.said)[1].bytes / 4);
}

TEST(Seismometer, OtherSeedsHaveOtherQuakesAndTheSameSeedTheSame) {
  const auto quakes = [](std::uint64_t seed) {
    return number(recorded(5 * 86400, seismometer(), seed), "park", "quakes");
  };
  EXPECT_EQ(quakes(3), quakes(3));
  EXPECT_TRUE(quakes(3) != quakes(4) || quakes(4) != quakes(5));
}

TEST(Seismometer, ParkingItTwiceBringsOneProduct) {
  Flight run = recorded(5000);
  run.command(seconds(9000), execute("again", "seismometer", "park"));
  EXPECT_EQ(run.time_of("again"), seconds(9000));
  EXPECT_EQ(products_in(run.said).size(), 2u);
}

TEST(Seismometer, AHollowStartRecordsNothing) {
  Flight run(station(seismometer()));
  run.disturb(seconds(0), world::HollowSuccess{"lander", "seismometer", "start"});
  run.command(seconds(0), execute("start", "seismometer", "start"));
  run.advance(seconds(700));
  EXPECT_EQ(run.stage("start"), Stage::completed);
  EXPECT_EQ(run.state("lander.seismometer"), (State{"parked", {}}));
}

TEST(Seismometer, GoesOnRecordingWhenTheProcessIsStartedAgain) {
  Flight run(station(seismometer()));
  run.command(seconds(0), execute("start", "seismometer", "start"));
  run.advance(seconds(5000));
  Flight next(station(seismometer()));
  next.world.restore(run.world.memory());
  next.command(seconds(9400), execute("park", "seismometer", "park"));
  next.advance(seconds(10001));
  EXPECT_EQ(number(next, "park", "recorded_s"), 9400);
}

}  // namespace
}  // namespace roci::sim::components
