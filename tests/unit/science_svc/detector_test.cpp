#include "science_svc/detector.hpp"

#include <gtest/gtest.h>

#include <random>

#include "science_svc/limits.hpp"

namespace roci::science {
namespace {

using temporal::seconds;

constexpr std::uint64_t kSeed = 5;
const terrain::Grid kMap{240, 240, 1.0, {0, 0}};

DetectorSettings eager() {
  DetectorSettings settings;
  settings.threshold = 0;
  settings.limit = 1000;
  settings.merge_m = -1;
  return settings;
}

TEST(Detector, ScoresFillTheUnitIntervalEvenly) {
  const Detector detector(eager(), kMap, kSeed);
  int above = 0;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y) {
      const double score = detector.score({x + 0.5, y + 0.5});
      ASSERT_GE(score, 0);
      ASSERT_LT(score, 1);
      above += score >= 0.85;
    }
  }
  EXPECT_NEAR(above, 1500, 180);  // five standard deviations
}

TEST(Detector, TheSameSeedAndPlaceScoreAlikeAndOthersDiffer) {
  const Detector detector(eager(), kMap, kSeed);
  EXPECT_EQ(detector.score({10.1, 20.2}), Detector(eager(), kMap, kSeed).score({10.9, 20.7}));
  EXPECT_NE(detector.score({10.1, 20.2}), detector.score({11.1, 20.2}));
  EXPECT_NE(detector.score({10.1, 20.2}), Detector(eager(), kMap, kSeed + 1).score({10.1, 20.2}));
}

TEST(Detector, LooksAtABoundedNumberOfPhotos) {
  DetectorSettings none = eager();
  none.threshold = 2;
  Detector detector(none, kMap, kSeed);
  EXPECT_FALSE(detector.look({std::string(kNameBytes + 1, 'x'), {10, 10}}, seconds(0)));
  for (std::size_t i = 0; i < kPhotos; ++i) {
    EXPECT_FALSE(detector.full()) << i;
    detector.look({"photo-" + std::to_string(i), {10, 10}}, seconds(0));
  }
  EXPECT_TRUE(detector.full());
}

TEST(Detector, FindsExactlyWhatScoresAboveTheThreshold) {
  DetectorSettings settings = eager();
  settings.threshold = 0.7;
  Detector detector(settings, kMap, kSeed);
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> anywhere(0, 239);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const terrain::Point p{anywhere(engine), anywhere(engine)};
    const auto find = detector.look({"image-" + std::to_string(i), p}, seconds(i));
    if (!find) {
      EXPECT_LT(detector.score(p), 0.7);
      continue;
    }
    ++found;
    EXPECT_GE(detector.score(p), 0.7);
    EXPECT_EQ(find->score, detector.score(p));
    EXPECT_NEAR(terrain::distance(find->place, p), settings.offset_m, 1);
    EXPECT_TRUE(kMap.contains(find->place));
  }
  EXPECT_NEAR(found, 90, 40);
}

TEST(Detector, LooksAtAPhotoOnce) {
  Detector detector(eager(), kMap, kSeed);
  EXPECT_TRUE(detector.look({"a", {50, 50}}, seconds(1)));
  EXPECT_FALSE(detector.look({"a", {150, 150}}, seconds(2)));
}

TEST(Detector, MergesFindsThatLieClose) {
  DetectorSettings settings = eager();
  settings.merge_m = 10;
  Detector detector(settings, kMap, kSeed);
  EXPECT_TRUE(detector.look({"a", {50, 50}}, seconds(1)));
  EXPECT_FALSE(detector.look({"b", {50, 50}}, seconds(2)));
  EXPECT_TRUE(detector.look({"c", {150, 150}}, seconds(3)));
}

TEST(Detector, KeepsItsDistanceInTime) {
  DetectorSettings settings = eager();
  settings.min_interval = seconds(100);
  Detector detector(settings, kMap, kSeed);
  EXPECT_TRUE(detector.look({"a", {50, 50}}, seconds(10)));
  EXPECT_FALSE(detector.look({"b", {100, 100}}, seconds(109)));
  EXPECT_TRUE(detector.look({"c", {150, 150}}, seconds(110)));
}

TEST(Detector, StopsAtItsLimit) {
  DetectorSettings settings = eager();
  settings.limit = 2;
  Detector detector(settings, kMap, kSeed);
  int found = 0;
  for (int i = 0; i < 10; ++i) {
    found += detector.look({std::to_string(i), {20.0 * i + 20, 20.0 * i + 20}}, seconds(i)).has_value();
  }
  EXPECT_EQ(found, 2);
}

TEST(Detector, FindsNothingWhenSwitchedOffOrOffTheMap) {
  DetectorSettings off = eager();
  off.enabled = false;
  EXPECT_FALSE(Detector(off, kMap, kSeed).look({"a", {50, 50}}, seconds(1)));
  EXPECT_FALSE(Detector(eager(), kMap, kSeed).look({"a", {-50, 50}}, seconds(1)));
}

}  // namespace
}  // namespace roci::science
