// The world of missions/faster: each number that describes a rover, its senses or the soil has a source or a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/mission_file.hpp"
#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/run_file.hpp"

namespace roci::sim::scenario {
namespace {

const std::filesystem::path kFaster = ROCI_SOURCE_DIR "/missions/faster";

mission::Entry drive_of(const mission::Entry& world, const std::string& robot) {
  for (const mission::Entry& one : world.at("robots").items())
    if (one.at("name").text() == robot) return one.at("components").items().front();
  throw std::out_of_range(robot);
}

// Each value of the section is that of the model, with words why, and each number of the section stands in the model.
void expect_same(const mission::Entry& model, const mission::Entry& section) {
  for (const auto& [key, entry] : model.fields()) {
    EXPECT_EQ(entry.at("value").number(), section.at(key).number()) << section.at(key).place();
    EXPECT_FALSE(entry.at("why").text().empty()) << entry.place();
  }
  for (const auto& [key, entry] : section.fields()) {
    if (entry.is_mapping() || entry.is_sequence() ||
        entry.text().find_first_not_of("0123456789.e-") != std::string::npos)
      continue;
    EXPECT_TRUE(model.find(key)) << entry.place() << ": '" << key << "' has no reason in model.yaml";
  }
}

TEST(FasterWorld, EachNumberHasASourceOrAReason) {
  const auto mission = mission::load_mission_file(kFaster).at("simulation");
  const auto model = mission::Entry::load(kFaster / "model.yaml");
  expect_same(model.at("primary"), drive_of(mission, "primary"));
  expect_same(model.at("scout"), drive_of(mission, "scout"));
  expect_same(model.at("soil_sensor"), drive_of(mission, "scout").at("soil_sensor"));
  expect_same(model.at("soil_sensor"), drive_of(mission, "primary").at("soil_sensor"));
  expect_same(model.at("soil"), mission.at("surface").at("soils").at("trap"));
}

// The scout's sensor judges for the vehicle that follows, and the primary's wheels for themselves.
TEST(FasterWorld, BothJudgeForThePrimaryAsItIs) {
  const auto mission = mission::load_mission_file(kFaster).at("simulation");
  const auto primary = drive_of(mission, "primary");
  for (const std::string robot : {"scout", "primary"})
    for (const std::string key : {"weight_n", "wheels", "wheel_width_m", "wheel_diameter_m"})
      EXPECT_EQ(drive_of(mission, robot).at("soil_sensor").at("for").at(key).number(),
                primary.at(key).number())
          << robot << ' ' << key;
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
