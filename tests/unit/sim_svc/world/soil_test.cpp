#include "sim_svc/world/soil.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::sim::world {
namespace {

SoilLayer two_soils() {
  SoilLayer layer;
  layer.soils["sand"] = {};
  layer.soils["dust"].frictional_modulus = 2e5;
  return layer;
}

TEST(SoilLayer, TheLastOfTheAreasThatOverlapCounts) {
  SoilLayer layer = two_soils();
  layer.areas = {{"sand", {10, 10}, 3, {}}, {"dust", {}, 0, {{{10, 8}, {14, 8}, {14, 12}, {10, 12}}}}};
  EXPECT_EQ(soil_at(layer, {8, 10}), &layer.soils["sand"]);
  EXPECT_EQ(soil_at(layer, {11, 10}), &layer.soils["dust"]);
  EXPECT_EQ(soil_at(layer, {13.9, 8.1}), &layer.soils["dust"]);
  EXPECT_EQ(soil_at(layer, {6.9, 10}), nullptr);
  EXPECT_EQ(soil_at(layer, {14.1, 10}), nullptr);
}

TEST(SoilLayer, ScattersBySeedWithinTheBoxAndClearOfTheDiscs) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SoilLayer layer = two_soils();
    layer.scattered = {{"dust", 4, 0.5, 1.5, {5, 5}, {25, 20}, {{"", {6, 6}, 2, {}}, {"", {20, 15}, 3, {}}}}};
    SoilLayer again = layer;
    const auto discs = layer.scattered[0].clear_of;
    scatter(layer, seed);
    scatter(again, seed);
    ASSERT_EQ(layer.areas, again.areas);
    ASSERT_EQ(layer.areas.size(), 4U);
    for (const SoilArea& area : layer.areas) {
      EXPECT_EQ(area.soil, "dust");
      EXPECT_TRUE(area.centre.x >= 5 && area.centre.x <= 25 && area.centre.y >= 5 && area.centre.y <= 20);
      EXPECT_TRUE(area.radius >= 0.5 && area.radius <= 1.5);
      for (const SoilArea& disc : discs)
        EXPECT_GE(terrain::distance(area.centre, disc.centre), area.radius + disc.radius);
    }
    SoilLayer other = two_soils();
    other.scattered = {{"dust", 4, 0.5, 1.5, {5, 5}, {25, 20}, discs}};
    scatter(other, seed + 1);
    EXPECT_NE(layer.areas, other.areas);
  }
}

TEST(SoilLayer, WhatFindsNoRoomIsLeftOut) {
  SoilLayer layer = two_soils();
  layer.scattered = {{"dust", 4, 0.5, 1.5, {5, 5}, {6, 6}, {{"", {5.5, 5.5}, 5, {}}}}};
  scatter(layer, 1);
  EXPECT_TRUE(layer.areas.empty());
}

}  // namespace
}  // namespace roci::sim::world
