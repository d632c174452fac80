// What a camera takes of its own accord.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using temporal::seconds;
using temporal::Time;
using world::Image;
using world::Output;

FlatSetup with_panoramas(double every_s, int views) {
  FlatSetup setup = flat_setup();
  setup.robot.camera.view.width_px = 24;
  setup.robot.camera.view.height_px = 16;
  setup.robot.camera.panorama_every_s = every_s;
  setup.robot.camera.panorama_views = views;
  return setup;
}

std::vector<Image> panorama_of(const Flight& run) {
  std::vector<Image> out;
  for (const Output& output : run.said)
    if (const auto* image = std::get_if<Image>(&output); image && image->kind == "panorama")
      out.push_back(*image);
  return out;
}

TEST(Panorama, LooksAllAroundAtIntervals) {
  Flight run(with_panoramas(600, 4));
  run.advance(seconds(1900));
  const auto views = panorama_of(run);
  ASSERT_EQ(views.size(), 12u);
  std::set<std::string> ids;
  for (std::size_t i = 0; i < views.size(); ++i) {
    ids.insert(views[i].id);
    EXPECT_EQ(views[i].taken, seconds(600) * static_cast<int>(i / 4 + 1));
    const double turned =
        std::remainder(views[i].taken_from.heading - static_cast<double>(i % 4) * std::numbers::pi / 2,
                       2 * std::numbers::pi);
    EXPECT_NEAR(turned, 0, 1e-9) << i;
    EXPECT_EQ(views[i].taken_from.x, 20);
  }
  EXPECT_EQ(ids.size(), 12u);
  EXPECT_FALSE(last_value(run.said, "rover.image." + views[0].id)) << "they are not kept";
}

TEST(Panorama, WaitsUntilTheRobotStands) {
  Flight run(with_panoramas(600, 2));
  run.drive(seconds(590), "d", "there", 24, 20);
  run.advance(seconds(620));
  EXPECT_TRUE(panorama_of(run).empty()) << "it drives";
  run.advance(seconds(1100));
  const auto views = panorama_of(run);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].taken, run.time_of("d")) << "the moment at which the drive is over";
  EXPECT_NEAR(views[0].taken_from.x, 24, 0.1);
}

TEST(Panorama, WaitsForAnImageAndPassesAFaultOver) {
  Flight run(with_panoramas(600, 1));
  run.command(seconds(590), execute("i", "camera", "image", {{"image", "one"}}));
  run.advance(seconds(700));
  ASSERT_EQ(panorama_of(run).size(), 1u);
  EXPECT_EQ(panorama_of(run)[0].taken, run.time_of("i"));
  run.disturb(seconds(1100), world::ComponentFault{"rover", "camera", seconds(1300)});
  run.advance(seconds(1700));
  EXPECT_EQ(panorama_of(run).size(), 1u) << "that of 1200 s is left out";
  run.advance(seconds(1800));
  EXPECT_EQ(panorama_of(run).size(), 2u);
}

TEST(Panorama, IsTakenAtOnceByAProcessThatTakesOverLate) {
  Flight before(with_panoramas(600, 1));
  before.advance(seconds(1000));
  world::World after(with_panoramas(600, 1).build(), 1);
  after.restore(before.world.memory());
  std::vector<Time> taken;
  for (const Output& output : after.advance(seconds(1300)))
    if (const auto* image = std::get_if<Image>(&output)) taken.push_back(image->taken);
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_GE(taken[0], seconds(1000));
  EXPECT_LT(taken[0], seconds(1002));
  EXPECT_EQ(taken[1], seconds(1200));
}

TEST(Panorama, NeverComesUnasked) {
  Flight run(flat_setup());
  run.advance(seconds(5000));
  EXPECT_TRUE(panorama_of(run).empty());
}

TEST(Panorama, DoesNotDependOnHowTheWorldIsSliced) {
  Flight whole(with_panoramas(300, 2)), sliced(with_panoramas(300, 2));
  for (Flight* run : {&whole, &sliced}) run->drive(seconds(250), "d", "there", 30, 26);
  whole.advance(seconds(2000));
  for (Time t = seconds(250); t < seconds(2000); t += seconds(7.3)) sliced.advance(t);
  sliced.advance(seconds(2000));
  EXPECT_EQ(panorama_of(whole), panorama_of(sliced));
  EXPECT_GT(panorama_of(whole).size(), 4u);
}

}  // namespace
}  // namespace roci::sim::components
