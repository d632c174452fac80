#include "sim_svc/scenario/surface_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::sim::scenario {
namespace {

using testing::HasSubstr;
using world::Look;

std::string error_of(const std::string& text) {
  world::Surface surface;
  try {
    read_surface(mission::Entry::parse(text, "scenario.yaml"), surface);
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SurfaceFile, WhatItSaysStandsInPlaceOfWhatWasThere) {
  world::Surface surface;
  read_surface(
      mission::Entry::parse(
          "sun: {elevation_deg: 40}\nodd_per_hectare: 5\nodd: [{x: 1, y: 2, radius: 0.5, look: dark}]\n",
          "mission.yaml"),
      surface);
  read_surface(mission::Entry::parse("sun: {azimuth_deg: 10}\nodd: [{x: 3, y: 4}]\n", "scenario.yaml"),
               surface);
  EXPECT_EQ(surface.sun.elevation_deg, 40);
  EXPECT_EQ(surface.sun.azimuth_deg, 10);
  EXPECT_EQ(surface.odd_per_hectare, 5);
  ASSERT_EQ(surface.placed.size(), 1u);
  EXPECT_EQ(surface.placed[0].x, 3);
  EXPECT_EQ(surface.placed[0].look, Look::bright);
}

TEST(SurfaceFile, FaultsNameTheirPlaceAndTheRemedy) {
  EXPECT_THAT(error_of("odd: [{x: 1, y: 2, look: brite}]\n"),
              HasSubstr("scenario.yaml:1:26: an odd target is no 'brite'; known: "
                        "bright, dark, layered, spotted"));
  EXPECT_THAT(error_of("sun: {elevation: 3}\n"), HasSubstr("unknown key 'elevation'"));
  EXPECT_THAT(error_of("odd_per_hectare: 101\n"), HasSubstr("must lie between"));
}

}  // namespace
}  // namespace roci::sim::scenario
