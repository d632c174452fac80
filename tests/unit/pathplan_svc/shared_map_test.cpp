#include "pathplan_svc/shared_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace roci::pathplan {
namespace {

using temporal::seconds;
using testing::ElementsAre;
using testing::HasSubstr;

const terrain::Grid kGrid{120, 120, 0.25, {0, 0}};  // 30 m x 30 m
const std::map<std::string, std::string> kTeam{
    {"scout_path", "scout"}, {"primary_path", "primary"}, {"third_path", "third"}, {"sim_svc", ""}};

FoundObstacle obstacle(const std::string& finder, const std::string& id, double x, double y,
                       double radius = 1, double found_s = 1, bool cleared = false) {
  return {finder, id, ObstacleKind::soil, {{x, y}, radius}, cleared, seconds(found_s)};
}

MapPatch patch(const std::string& robot, std::uint64_t number, std::vector<FoundObstacle> obstacles,
               std::uint32_t incarnation = 1) {
  return {robot + "_path", robot, {incarnation, number}, std::move(obstacles)};
}

SharedMap primary() { return {"primary", kGrid, kTeam}; }

TEST(SharedMap, HoldsWhatItFoundAndWhatItIsTold) {
  SharedMap map = primary();
  EXPECT_TRUE(map.find(obstacle("primary", "a", 5, 5)).changed);
  EXPECT_TRUE(map.take(patch("scout", 1, {obstacle("scout", "a", 9, 9)})).changed);
  EXPECT_THAT(map.discs(), ElementsAre(Disc{{5, 5}, 1}, Disc{{9, 9}, 1}));
  EXPECT_FALSE(map.take(patch("scout", 2, {obstacle("scout", "a", 9, 9)})).changed) << "it is known";
}

TEST(SharedMap, ALaterWordMovesOrClearsAnObstacle) {
  SharedMap map = primary();
  map.take(patch("scout", 1, {obstacle("scout", "a", 9, 9, 1, 10)}));
  EXPECT_FALSE(map.take(patch("third", 1, {obstacle("scout", "a", 3, 3, 1, 9)})).changed) << "an older word";
  EXPECT_TRUE(map.take(patch("scout", 2, {obstacle("scout", "a", 9, 9, 2, 11)})).changed);
  EXPECT_TRUE(map.take(patch("scout", 3, {obstacle("scout", "a", 9, 9, 2, 12, true)})).changed);
  EXPECT_TRUE(map.discs().empty());
  EXPECT_FALSE(map.take(patch("third", 2, {obstacle("scout", "a", 9, 9, 2, 11)})).changed)
      << "who has not heard that it is gone does not bring it back";
}

TEST(SharedMap, OnWhatARobotFoundItselfNobodyElseHasASay) {
  SharedMap map = primary();
  map.find(obstacle("primary", "a", 5, 5));
  EXPECT_EQ(map.take(patch("scout", 1, {obstacle("primary", "a", 5, 5, 1, 99, true)})).refusal, "");
  EXPECT_EQ(map.discs().size(), 1U);
  EXPECT_NE(map.find(obstacle("scout", "b", 5, 5)).refusal, "");
}

std::string refusal(const MapPatch& bad) {
  SharedMap map = primary();
  map.take(patch("scout", 5, {obstacle("scout", "known", 9, 9)}));
  const auto before = map.all();
  const Intake intake = map.take(bad);
  EXPECT_FALSE(intake.changed);
  EXPECT_EQ(map.all(), before) << "a patch is taken whole or not at all";
  return intake.refusal;
}

TEST(SharedMap, RefusesABadPatchAsAWholeAndSaysWhy) {
  const FoundObstacle good = obstacle("scout", "good", 4, 4);
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", 40, 9)})), HasSubstr("off the map"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", 9, -1.1)})), HasSubstr("off the map"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", std::nan(""), 9)})),
              HasSubstr("no finite place"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", 9, 9, INFINITY)})),
              HasSubstr("no finite place"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", 9, 9, -1)})),
              HasSubstr("no finite place"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "b", 9, 9, 31)})),
              HasSubstr("larger than the map"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle("scout", "", 9, 9)})), HasSubstr("1 to 128 bytes"));
  EXPECT_THAT(refusal(patch("scout", 6, {good, obstacle(std::string(129, 'x'), "b", 9, 9)})),
              HasSubstr("1 to 128 bytes"));
  EXPECT_THAT(refusal(patch("scout", 4, {good})), HasSubstr("a newer one"));
  EXPECT_THAT(refusal(patch("stranger", 1, {good})), HasSubstr("no service of the team"));
  EXPECT_THAT(refusal({"sim_svc", "", {1, 1}, {good}}), HasSubstr("no service of the team"));
  EXPECT_THAT(refusal({"scout_path", "third", {1, 9}, {good}}), HasSubstr("no service of the team"));
  EXPECT_EQ(refusal(patch("scout", 6, {})), "");
}

TEST(SharedMap, AStartOfTheAuthorBeginsItsNumbersAnew) {
  SharedMap map = primary();
  map.take(patch("scout", 5, {obstacle("scout", "a", 9, 9)}, 1));
  EXPECT_EQ(map.take(patch("scout", 1, {obstacle("scout", "b", 9, 9)}, 2)).refusal, "");
  EXPECT_THAT(map.take(patch("scout", 6, {}, 1)).refusal, HasSubstr("a newer one"));
}

TEST(SharedMap, HoldsNoMoreThanItsBound) {
  SharedMap map = primary();
  std::vector<FoundObstacle> many;
  for (std::size_t i = 0; i < SharedMap::kMost; ++i)
    many.push_back(obstacle("scout", std::to_string(i), 9, 9));
  EXPECT_EQ(map.take(patch("scout", 1, many)).refusal, "");
  EXPECT_EQ(map.take(patch("scout", 2, many)).refusal, "") << "the same again needs no room";
  EXPECT_THAT(map.take(patch("third", 1, {obstacle("third", "x", 9, 9)})).refusal,
              HasSubstr("more than 500"));
  EXPECT_THAT(map.find(obstacle("primary", "x", 9, 9)).refusal, HasSubstr("no room"));
}

// Patches that come twice, late, by way of others or never: whoever has heard the newest of all has the same map.
TEST(SharedMap, TheSameFindingsGiveTheSameMapInWhateverOrderTheyAreTold) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned bound) { return random() % bound; };
    std::map<std::string, SharedMap> maps;
    for (const std::string robot : {"scout", "primary", "third"})
      maps.emplace(robot, SharedMap(robot, kGrid, kTeam));
    std::map<std::string, std::uint64_t> told;
    std::vector<std::pair<std::string, MapPatch>> under_way;
    const auto tell = [&](const std::string& robot) {
      const MapPatch all = patch(robot, ++told[robot], maps.at(robot).all());
      for (const auto& [other, map] : maps)
        if (other != robot) under_way.emplace_back(other, all);
    };
    const auto arrive = [&](std::size_t which) {
      const auto [to, what] = under_way[which];
      const Intake intake = maps.at(to).take(what);
      EXPECT_TRUE(intake.refusal.empty() || intake.refusal == "a newer one of the same author is known");
    };
    const std::vector<std::string> names{"scout", "primary", "third"};
    for (int step = 0; step < 40; ++step) {
      const std::string& robot = names[below(3)];
      const unsigned what = below(3);
      if (what == 0)
        maps.at(robot).find(obstacle(robot, std::to_string(below(4)), below(30), below(30), 1 + below(3),
                                     below(20), below(4) == 0));
      if (what == 1) tell(robot);
      if (what == 2 && !under_way.empty()) {
        const std::size_t which = below(static_cast<unsigned>(under_way.size()));
        arrive(which);
        if (below(2) == 0) under_way.erase(under_way.begin() + static_cast<std::ptrdiff_t>(which));
      }
    }
    under_way
        .clear();  // the rest is lost; then each says its last word, and once more what it has heard by then
    for (int round = 0; round < 2; ++round) {
      for (const std::string& robot : names) tell(robot);
      std::shuffle(under_way.begin(), under_way.end(), random);
      for (std::size_t i = 0; i < under_way.size(); ++i) arrive(i);
      under_way.clear();
    }
    EXPECT_EQ(maps.at("scout").all(), maps.at("primary").all()) << "seed " << seed;
    EXPECT_EQ(maps.at("scout").all(), maps.at("third").all()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace roci::pathplan
