#include "sim_svc/scenario/soil_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim_svc/scenario/surface_file.hpp"

namespace roci::sim::scenario {
namespace {

using testing::HasSubstr;

constexpr const char* kTrap =
    "soils: {trap: {n: 1, k_c: 0, k_phi: 2e5, cohesion_pa: 100, friction_deg: 28, shear_m: 0.02}}\n";

world::Surface surface_of(const std::string& text) {
  world::Surface surface;
  read_surface(mission::Entry::parse(text, "mission.yaml"), surface);
  return surface;
}

std::string soil_error_of(const std::string& text) {
  try {
    surface_of(kTrap + text);
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SoilFile, ReadsSoilsAreasAndWhatIsScattered) {
  const world::SoilLayer layer = surface_of(std::string(kTrap) +
                                      "soil_areas: [{soil: trap, x: 1, y: 2, radius: 3}, {soil: trap, "
                                      "outline: {polygon: [[0, 0], [1, 0], [1, 1]]}}]\n"
                                      "scattered_soil: [{soil: trap, count: 3, radius: [0.5, 1], x: [4, 9], "
                                      "y: [5, 6], clear_of: [{x: 4, y: 5, radius: 1}]}]\n")
                                     .soil;
  EXPECT_EQ(layer.soils.at("trap"), (world::Soil{1, 0, 2e5, 100, 28, 0.02}));
  ASSERT_EQ(layer.areas.size(), 2U);
  EXPECT_EQ(layer.areas[0], (world::SoilArea{"trap", {1, 2}, 3, {}}));
  EXPECT_EQ(layer.areas[1].outline.corners.size(), 3U);
  ASSERT_EQ(layer.scattered.size(), 1U);
  const world::ScatteredSoil& some = layer.scattered[0];
  EXPECT_EQ(some.count, 3);
  EXPECT_EQ(some.most_radius, 1);
  EXPECT_EQ(some.north_east, (terrain::Point{9, 6}));
  EXPECT_EQ(some.clear_of.size(), 1U);
}

TEST(SoilFile, AScenarioReplacesTheAreasAndKeepsTheSoils) {
  world::Surface surface = surface_of(std::string(kTrap) + "soil_areas: [{soil: trap, x: 1, y: 2, radius: 3}]\n");
  read_surface(mission::Entry::parse("soil_areas: [{soil: trap, x: 7, y: 7, radius: 1}]\n", "scenario.yaml"),
               surface);
  ASSERT_EQ(surface.soil.areas.size(), 1U);
  EXPECT_EQ(surface.soil.areas[0].centre.x, 7);
  EXPECT_TRUE(surface.soil.soils.contains("trap"));
}

TEST(SoilFile, FaultsNameTheirPlaceAndTheRemedy) {
  EXPECT_THAT(soil_error_of("soil_areas: [{soil: trop, x: 1, y: 2, radius: 3}]\n"),
              HasSubstr("mission.yaml:2:21: no soil 'trop'; known: trap"));
  EXPECT_THAT(soil_error_of("soil_areas: [{soil: trap, x: 1, y: 2, radius: 0}]\n"), HasSubstr("mission.yaml:2:"));
  EXPECT_THAT(soil_error_of("scattered_soil: [{soil: trap, x: [9, 4], y: [1, 2]}]\n"),
              HasSubstr("is a range [from, to] of two numbers, the lower one first"));
  EXPECT_THAT(soil_error_of("scattered_soil: [{soil: trap, x: [1, 4], y: [1, 2], count: 1001}]\n"),
              HasSubstr("'count' must lie between"));
  EXPECT_THAT(soil_error_of("scattered_soil: [{soil: trap, x: [1, 4], y: [1, 2], radius: [0, 2]}]\n"),
              HasSubstr("a radius must be above 0"));
}

TEST(SoilFile, NumbersOfASoilHaveBounds) {
  for (const std::string wrong : {"n: 2.5", "k_phi: 0", "friction_deg: 0", "shear_m: 0", "k_c: -1"}) {
    try {
      surface_of("soils: {trap: {" + wrong + "}}\n");
      ADD_FAILURE() << wrong;
    } catch (const mission::FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("must lie between")) << wrong;
    }
  }
}

}  // namespace
}  // namespace roci::sim::scenario
