#include "core/terrain/way.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace roci::terrain {
namespace {

using testing::HasSubstr;

double length(const Way& way) {
  double out = 0;
  for (std::size_t i = 1; i < way.size(); ++i) out += distance(way[i - 1], way[i]);
  return out;
}

Way random_way(std::mt19937_64& random, std::size_t points) {
  std::uniform_real_distribution<double> metres(-50, 50);
  Way way;
  for (std::size_t i = 0; i < points; ++i) way.push_back({metres(random), metres(random)});
  return way;
}

TEST(Way, TextReadsBackTheSameToTheLastBit) {
  std::mt19937_64 random(1);
  for (std::size_t points = 1; points <= 64; ++points) {
    const Way way = random_way(random, points);
    const WayInText again = read_way(to_text(way), 64);
    EXPECT_EQ(again.fault, "");
    EXPECT_EQ(again.way, way);
  }
  EXPECT_EQ(to_text({{1.5, -2}, {0.1, 3}}), "1.5,-2;0.1,3");
}

TEST(Way, TwoTextsAreJoinedByASemicolon) {
  EXPECT_EQ(read_way(to_text({{1, 2}, {3, 4}}) + ";" + to_text({{3, 4}, {5, 6}}), 4).way,
            (Way{{1, 2}, {3, 4}, {3, 4}, {5, 6}}));
}

TEST(Way, AFaultNamesThePoint) {
  for (const char* bad : {"1,2;;3,4", "1,2;3", "1,2;3,four", "1,2;3,inf", "1,2;nan,4", "1,2;3,4,5",
                          "1,2; 3,4", "1,2;3,1e999", "1,2;"}) {
    EXPECT_THAT(read_way(bad, 9).fault, HasSubstr("point 2")) << bad;
    EXPECT_TRUE(read_way(bad, 9).way.empty());
  }
  EXPECT_THAT(read_way("", 9).fault, HasSubstr("point 1"));
  EXPECT_THAT(read_way("1,2;3,4;5,6", 2).fault, HasSubstr("3 points; a way has at most 2"));
}

TEST(Way, IsCutAlongItself) {
  const Way way{{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(cut_short(way, 0), way);
  EXPECT_EQ(cut_short(way, -1), way);
  EXPECT_EQ(cut_short(way, 1), (Way{{0, 0}, {4, 0}, {4, 2}}));
  EXPECT_EQ(cut_short(way, 3), (Way{{0, 0}, {4, 0}}));
  EXPECT_EQ(cut_short(way, 5), (Way{{0, 0}, {2, 0}}));
  EXPECT_EQ(cut_short(way, 7), (Way{{0, 0}}));
  EXPECT_EQ(cut_short(way, 70), (Way{{0, 0}})) << "its first point stays";
}

TEST(Way, LosesTheLengthThatIsCut) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    const Way way = random_way(random, 1 + random() % 8);
    const double cut = std::uniform_real_distribution<double>(0, 200)(random);
    EXPECT_NEAR(length(cut_short(way, cut)), std::max(0.0, length(way) - cut), 1e-9);
  }
}

TEST(Way, EndsWithTheHeadingOfItsLastLegOfAnyLength) {
  EXPECT_DOUBLE_EQ(heading_at_end({{0, 0}, {4, 0}, {4, 3}}, 9), std::acos(0));
  EXPECT_DOUBLE_EQ(heading_at_end({{0, 0}, {4, 0}, {4, 0}}, 9), 0);
  EXPECT_EQ(heading_at_end({{4, 0}, {4, 0}}, 9), 9);
  EXPECT_EQ(heading_at_end({{4, 0}}, 9), 9);
}

}  // namespace
}  // namespace roci::terrain
