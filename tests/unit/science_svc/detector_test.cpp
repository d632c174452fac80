#include "science_svc/detector.hpp"

#include <gtest/gtest.h>

#include "core/terrain/pgm.hpp"
#include "science_svc/limits.hpp"
#include "tests/unit/science_svc/photos.hpp"

namespace roci::science {
namespace {

using temporal::seconds;

constexpr double kThreshold = 0.75;

DetectorSettings eager() {
  DetectorSettings settings;
  settings.threshold = kThreshold;
  settings.limit = 1000;
  settings.merge_m = 0;
  return settings;
}

// A detector on flat ground without an end that has seen some of it.
Detector taught(const DetectorSettings& settings) {
  Detector out(settings, nullptr);
  for (std::uint64_t i = 0; i < 4; ++i)
    out.learn(photo("plain-" + std::to_string(i), {0, 0}, made_ground(i)));
  return out;
}

std::vector<Find> show(Detector& detector, const std::string& id, terrain::Point at, temporal::Time now) {
  return detector.look(photo(id, at, made_ground(77, 12)), now);
}

TEST(Detector, FindsExactlyWhatScoresAboveTheThreshold) {
  for (const double threshold : {0.3, 0.75, 0.999}) {
    DetectorSettings settings = eager();
    settings.threshold = threshold;
    Detector detector(settings, nullptr);
    for (std::uint64_t i = 0; i < 4; ++i)
      detector.learn(photo("plain-" + std::to_string(i), {0, 0}, made_ground(i)));
    const Photo odd = photo("odd", {0, 0}, made_ground(77, 12));
    Detector other = detector;
    const auto all = other.candidates(odd, 0.01);
    ASSERT_FALSE(all.empty());
    const auto finds = detector.look(odd, seconds(1));
    EXPECT_EQ(finds.empty(), all.front().score < threshold) << threshold;
    for (const Find& one : finds) EXPECT_GE(one.score, threshold);
  }
}

TEST(Detector, ScoresComeFromThePixels) {
  Detector detector = taught(eager());
  const auto plain = detector.candidates(photo("p", {0, 0}, made_ground(50)), 0);
  const auto odd = detector.candidates(photo("o", {0, 0}, made_ground(50, 12)), 0);
  ASSERT_FALSE(plain.empty());
  ASSERT_FALSE(odd.empty());
  EXPECT_GT(odd.front().score, kThreshold);
  EXPECT_LT(plain.front().score, odd.front().score);
}

TEST(Detector, PlacesAFindByTheCamerasGeometry) {
  Detector detector = taught(eager());
  const auto finds = show(detector, "odd", {100, 200}, seconds(1));
  ASSERT_EQ(finds.size(), 1u);
  const auto truth = ground_at({}, {}, {{100, 200}, 0}, kWidth, kHeight, 48, 38, 50);
  ASSERT_TRUE(truth);
  EXPECT_LT(terrain::distance(finds[0].place, *truth), 1.5) << finds[0].place.x << ", " << finds[0].place.y;
  EXPECT_EQ(finds[0].id, find_id(finds[0].place));
}

TEST(Detector, ACropShowsTheFind) {
  Detector detector = taught(eager());
  const auto finds = show(detector, "odd", {0, 0}, seconds(1));
  ASSERT_EQ(finds.size(), 1u);
  const terrain::GreyImage crop = terrain::parse_pgm(finds[0].crop, "crop");
  int light = 0;
  for (const auto pixel : crop.pixels) light += pixel > 220;
  EXPECT_GT(light, 70) << "of the 144 pixels of the square";
  EXPECT_LT(crop.width * crop.height, kWidth * kHeight / 4);
}

TEST(Detector, WhatIsEverywhereIsLessNovel) {
  Detector used(eager(), nullptr), unused(eager(), nullptr);
  for (std::uint64_t i = 0; i < 8; ++i) {
    used.learn(photo(std::to_string(i), {0, 0}, made_ground(i, 20)));
    unused.learn(photo(std::to_string(i), {0, 0}, made_ground(i)));
  }
  const Photo again = photo("again", {0, 0}, made_ground(77, 20));
  EXPECT_LT(used.candidates(again, 0).front().score, unused.candidates(again, 0).front().score - 0.05);
}

TEST(Detector, LooksAtAPhotoOnce) {
  Detector detector = taught(eager());
  EXPECT_EQ(show(detector, "a", {50, 50}, seconds(1)).size(), 1u);
  EXPECT_TRUE(show(detector, "a", {150, 150}, seconds(2)).empty());
}

TEST(Detector, MergesFindsThatLieClose) {
  DetectorSettings settings = eager();
  settings.merge_m = 10;
  Detector detector = taught(settings);
  EXPECT_EQ(show(detector, "a", {50, 50}, seconds(1)).size(), 1u);
  EXPECT_TRUE(show(detector, "b", {55, 50}, seconds(2)).empty());
  EXPECT_EQ(show(detector, "c", {150, 150}, seconds(3)).size(), 1u);
}

TEST(Detector, KeepsItsDistanceInTime) {
  DetectorSettings settings = eager();
  settings.min_interval = seconds(100);
  Detector detector = taught(settings);
  EXPECT_EQ(show(detector, "a", {50, 50}, seconds(10)).size(), 1u);
  EXPECT_TRUE(show(detector, "b", {100, 100}, seconds(109)).empty());
  EXPECT_EQ(show(detector, "c", {150, 150}, seconds(110)).size(), 1u);
}

TEST(Detector, StopsAtItsLimit) {
  DetectorSettings settings = eager();
  settings.limit = 2;
  Detector detector = taught(settings);
  std::size_t found = 0;
  for (int i = 0; i < 6; ++i) found += show(detector, std::to_string(i), {100.0 * i, 0}, seconds(i)).size();
  EXPECT_EQ(found, 2u);
}

TEST(Detector, RemembersWhatAnEarlierProcessRaised) {
  DetectorSettings settings = eager();
  settings.merge_m = 5;
  settings.limit = 2;
  Detector first = taught(settings), second = taught(settings);
  const auto finds = show(first, "a", {50, 50}, seconds(1));
  ASSERT_EQ(finds.size(), 1u);
  second.remember(finds[0].id, seconds(2));
  second.remember(finds[0].id, seconds(2));
  second.remember("ridge", seconds(2));
  EXPECT_TRUE(show(second, "a", {50, 50}, seconds(3)).empty()) << "the same place";
  EXPECT_EQ(show(second, "b", {150, 50}, seconds(4)).size(), 1u);
  EXPECT_TRUE(show(second, "c", {250, 50}, seconds(5)).empty()) << "the limit counts the earlier one";
}

TEST(Detector, AnIdSaysThePlace) {
  EXPECT_EQ(find_id({74.4, -51.6}), "find-e74s52");
  EXPECT_EQ(place_of("find-w3n0"), (terrain::Point{-3, 0}));
  EXPECT_EQ(place_of("find-e500030n4500024"), (terrain::Point{500'030, 4'500'024}));
  for (const char* word : {"find-1", "ridge", "find-e1", "find-e1n2x", "find-e-1n2", "find-e01n2",
                           "find-x1n2", "find-e999999999n1", ""})
    EXPECT_FALSE(place_of(word)) << word;
}

// A map in projected coordinates: northings of millions of metres are no place that nobody can be at.
TEST(Detector, FindsOnMapsFarFromTheirOrigin) {
  const terrain::Grid grid{60, 60, 1.0, {500'000, 4'500'000}};
  terrain::SiteLayers layers;
  layers.elevation.assign(grid.cell_count(), 120.0F);
  layers.rock_height.assign(grid.cell_count(), 0.0F);
  layers.occupancy.assign(grid.cell_count(), terrain::Occupancy::free);
  DetectorSettings settings = eager();
  settings.threshold = 0;
  Detector detector(settings, std::make_shared<const terrain::Site>(grid, layers));
  const auto finds = detector.look(photo("a", {500'030, 4'500'030}, made_ground(1, 12)), seconds(1));
  ASSERT_EQ(finds.size(), 1u);
  EXPECT_LT(terrain::distance(finds[0].place, {500'030, 4'500'030}), 12);
  EXPECT_EQ(place_of(finds[0].id), finds[0].place);
}

TEST(Detector, FindsNothingWhenSwitchedOffOffTheMapOrNowhere) {
  DetectorSettings off = eager();
  off.threshold = 0;
  const Photo any = photo("a", {50, 50}, made_ground(1, 12));
  EXPECT_EQ(Detector(off, nullptr).look(any, seconds(1)).size(), 1u) << "a threshold of 0 takes every image";
  EXPECT_TRUE(
      Detector(off, nullptr).look(photo("a", {std::nan(""), 0}, made_ground(1, 12)), seconds(1)).empty());
  EXPECT_TRUE(Detector(off, nullptr).look(photo("a", {1e300, 0}, made_ground(1, 12)), seconds(1)).empty());
  EXPECT_TRUE(
      Detector(off, nullptr).look(photo("a", {0, 0}, made_ground(1, 12), 1 / 0.0), seconds(1)).empty());
  off.enabled = false;
  EXPECT_TRUE(Detector(off, nullptr).look(any, seconds(1)).empty());
}

TEST(Detector, LooksAtABoundedNumberOfPhotos) {
  DetectorSettings settings = eager();
  settings.reach_m = 1;  // nothing to see, so that many are quick
  Detector detector(settings, nullptr);
  EXPECT_TRUE(
      detector.look(photo(std::string(kNameBytes + 1, 'x'), {10, 10}, made_ground(1)), seconds(0)).empty());
  terrain::GreyImage tiny{16, 16, 255, std::vector<std::uint16_t>(256, 9)};
  for (std::size_t i = 0; i < kPhotos; ++i) {
    ASSERT_FALSE(detector.full()) << i;
    detector.look(photo("photo-" + std::to_string(i), {10, 10}, tiny), seconds(0));
  }
  EXPECT_TRUE(detector.full());
}

}  // namespace
}  // namespace roci::science
