#include "sim_svc/components/survey_camera.hpp"

#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using world::Tier;

namespace {

SurveyCameraSettings camera() {
  SurveyCameraSettings out;
  out.duration_noise = out.power_noise = 0;
  out.values = {{"0", 0.9}, {"1", 0.4}};
  out.visual = {{"0_0", 0.3}, {"0_1", 0.8}, {"1_0", 0.5}};
  out.products = {{"find_targets", {{"trench_{site}", Tier::decisional, 3000}}},
                  {"panorama", {{"panorama", Tier::mandatory, 6000}}}};
  return out;
}

Flight lander(const SurveyCameraSettings& settings, double data_bytes = 1e6) {
  world::RobotSetup robot;
  robot.name = "lander";
  robot.power = world::PowerSetup{{1e7, 0}, 5e6};
  robot.data_bytes = data_bytes;
  robot.components = {part<SurveyCamera>("camera", "survey_camera", settings)};
  return Flight(world::WorldSetup{{}, {}, {robot}});
}

TEST(SurveyCamera, FindsSitesAndWhatTheyAreWorth) {
  Flight run = lander(camera());
  run.command(seconds(10), execute("f", "camera", "find_sites"));
  EXPECT_EQ(run.state("lander.camera"), (State{"surveying", {"find_sites"}}));
  run.advance(seconds(8000));
  EXPECT_EQ(run.time_of("f"), seconds(7210));
  const auto results = run.last_ack("f")->status.results;
  EXPECT_EQ(results.values, (std::map<std::string, temporal::Value>{{"value_0", 0.9}, {"value_1", 0.4}}));
  EXPECT_NEAR(results.energy_j.value(), 7200 * 60, 1e-6);
  EXPECT_TRUE(products_in(run.said).empty());
}

TEST(SurveyCamera, FindsTheTargetsOfASite) {
  Flight run = lander(camera());
  run.command(seconds(10), execute("f", "camera", "find_targets", {{"site", "0"}}));
  run.advance(seconds(8000));
  EXPECT_EQ(run.last_ack("f")->status.results.values,
            (std::map<std::string, temporal::Value>{{"visual_0_0", 0.3}, {"visual_0_1", 0.8}}));
  ASSERT_EQ(products_in(run.said).size(), 1u);
  EXPECT_EQ(products_in(run.said)[0].id, "trench_0");
  EXPECT_EQ(products_in(run.said)[0].created, seconds(3610));
  run.command(seconds(9000), execute("g", "camera", "find_targets", {{"site", "7"}}));
  EXPECT_EQ(run.code("g"), "unknown-site");
}

TEST(SurveyCamera, EachPanoramaIsAProductOfItsOwn) {
  Flight run = lander(camera(), 10000);
  run.command(seconds(10), execute("p", "camera", "panorama"));
  run.advance(seconds(4000));
  run.command(seconds(5000), execute("q", "camera", "panorama"));
  run.advance(seconds(9000));
  EXPECT_EQ(run.code("q"), "data-full") << "6000 bytes are on board, of 10000";
  ASSERT_EQ(products_in(run.said).size(), 1u);
  EXPECT_EQ(products_in(run.said)[0].source, "p");
}

TEST(SurveyCamera, AHollowSuccessBringsNothing) {
  Flight run = lander(camera());
  run.disturb(seconds(1), world::HollowSuccess{"lander", "camera", "panorama"});
  run.command(seconds(10), execute("p", "camera", "panorama"));
  run.advance(seconds(4000));
  EXPECT_EQ(run.stage("p"), Stage::completed);
  EXPECT_TRUE(products_in(run.said).empty());
}

TEST(SurveyCamera, SlowedItTakesLonger) {
  Flight run = lander(camera());
  run.command(seconds(10), execute("p", "camera", "panorama"));
  run.disturb(seconds(20), world::ComponentFault{"lander", "camera", seconds(1020), 0.5});
  run.advance(seconds(9000));
  EXPECT_EQ(run.time_of("p"), seconds(3610 + 500));
}

}  // namespace
}  // namespace roci::sim::components
