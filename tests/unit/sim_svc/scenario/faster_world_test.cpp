// The world of missions/faster: each number that describes a rover, its senses or the soil has a source or a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/mission_file.hpp"
#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/run_file.hpp"

namespace roci::sim::scenario {
namespace {

const std::filesystem::path kFaster = ROCI_SOURCE_DIR "/missions/faster";

mission::Entry named(const mission::Entry& list, const std::string& name) {
  for (const mission::Entry& one : list.items())
    if (one.at("name").text() == name) return one;
  throw std::out_of_range(name);
}

mission::Entry robot(const mission::Entry& world, const std::string& name) {
  return named(world.at("robots"), name);
}

mission::Entry drive_of(const mission::Entry& world, const std::string& name) {
  return named(robot(world, name).at("components"), "nav");
}

// Each value of the section is that of the model, with words why, and each number of the section stands in the model.
void expect_same(const mission::Entry& model, const mission::Entry& section, bool reasons = true) {
  for (const auto& [key, entry] : model.fields()) {
    EXPECT_EQ((reasons ? entry.at("value") : entry).number(), section.at(key).number())
        << section.at(key).place();
    if (reasons) {
      EXPECT_FALSE(entry.at("why").text().empty()) << entry.place();
    }
  }
  for (const auto& [key, entry] : section.fields()) {
    if (entry.is_mapping() || entry.is_sequence() ||
        entry.text().find_first_not_of("0123456789.e-") != std::string::npos)
      continue;
    EXPECT_TRUE(model.find(key)) << entry.place() << ": '" << key << "' has no reason in model.yaml";
  }
}

// All components that the world gives a robot, so that a new one is asked for its reasons, too.
std::vector<std::string> components_of(const mission::Entry& world, const std::string& name) {
  std::vector<std::string> out;
  for (const mission::Entry& one : robot(world, name).at("components").items())
    out.push_back(one.at("name").text());
  return out;
}

TEST(FasterWorld, EachNumberHasASourceOrAReason) {
  const auto world = mission::load_mission_file(kFaster).at("simulation");
  const auto model = mission::Entry::load(kFaster / "model.yaml");
  EXPECT_THAT(components_of(world, "primary"), ::testing::ElementsAre("nav", "eye", "navcams", "antenna"));
  EXPECT_THAT(components_of(world, "scout"), ::testing::ElementsAre("nav", "navcams"));
  EXPECT_FALSE(model.at("instruments").at("why").text().empty());
  for (const std::string name : {"primary", "scout"}) {
    expect_same(model.at(name), drive_of(world, name));
    const auto sensor = drive_of(world, name).at("soil_sensor");
    expect_same(model.at("soil_sensor"), sensor);
    expect_same(model.at("believed"), sensor.at("believed"));
    for (const mission::Entry& one : sensor.at("instruments").items())
      expect_same(model.at("instruments").at(one.at("name").text()), one, false);
    expect_same(model.at(name + "_power"), robot(world, name).at("power"));
    expect_same(model.at(name + "_planner"), mission::Entry::load(kFaster / (name + ".yaml")).at("rover"));
  }
  const auto primary = robot(world, "primary").at("components");
  expect_same(model.at("eye"), named(primary, "eye"));
  expect_same(model.at("primary_navcams"), named(primary, "navcams"));
  expect_same(model.at("antenna_tell"), named(primary, "antenna").at("commands").at("tell"));
  expect_same(model.at("antenna_downlink"), named(primary, "antenna").at("commands").at("downlink"));
  expect_same(model.at("scout_navcams"),
              named(robot(world, "scout").at("components"), "navcams").at("commands").at("look"));
  expect_same(model.at("soil"), world.at("surface").at("soils").at("trap"));
  expect_same(model.at("science_camera"), mission::load_mission_file(kFaster).at("science").at("camera"));
}

// The scout's sensor judges for the vehicle that follows, and the primary's wheels for themselves.
TEST(FasterWorld, BothJudgeForThePrimaryAsItIs) {
  const auto mission = mission::load_mission_file(kFaster).at("simulation");
  const auto primary = drive_of(mission, "primary");
  for (const std::string name : {"scout", "primary"})
    for (const std::string key : {"weight_n", "wheels", "wheel_width_m", "wheel_diameter_m"})
      EXPECT_EQ(drive_of(mission, name).at("soil_sensor").at("for").at(key).number(),
                primary.at(key).number())
          << name << ' ' << key;
}

TEST(FasterWorld, IsReadWithItsRoversAndItsTrap) {
  const RunSetup run = load_run(kFaster, "yard", components::standard_types());
  ASSERT_EQ(run.world.robots.size(), 2U);
  EXPECT_TRUE(world::soil_at(run.world.ground.surface.soil, {11, 15}));
  EXPECT_EQ(run.world.ground.site->occupancy(terrain::Point{11, 15}), terrain::Occupancy::free)
      << "no map shows it";
  EXPECT_GT(run.world.ground.site->rock_height(terrain::Point{15.5, 15.2}), 0.9);
}

}  // namespace
}  // namespace roci::sim::scenario
