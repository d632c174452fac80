// Two rovers before a sand trap that no map shows: the scout finds it, its map goes to the primary, and both go around; the
// same flight without the patch ends in the trap. No planner and no executive: a script commands.
#include "tests/scenario/yard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/run_file.hpp"
#include "tests/scenario/true_way.hpp"

namespace roci::scenario {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr int kMostNoGo = 8;  // after which a flight gives up

bool found_no_go(const YardWord& word) { return word.code == "no-go"; }

// The scout goes ahead until it is there; after each No-Go and at the end its map is told. Then the primary follows.
Yard::Script scout_first(bool tells) {
  return [tells, phase = 0,
          tries = 0](const std::vector<YardWord>& words) mutable -> std::optional<YardCommand> {
    const auto go = [] { return drive("scout", 21.5, 15); };
    if (phase == 0) {  // to begin with
      phase = 1;
      return go();
    }
    if (phase == 1) {  // the scout has driven
      if (found_no_go(words.back()) && ++tries <= kMostNoGo) {
        if (!tells) return go();
        phase = 2;
        return tell("scout");
      }
      phase = 3;
      return drive("primary", 20, 15);
    }
    if (phase == 2) {  // the map was told
      phase = 1;
      return go();
    }
    return std::nullopt;
  };
}

struct Transports {
  std::string name;
  std::vector<std::string> vendors;
};

void PrintTo(const Transports& one, std::ostream* out) { *out << one.name; }

const Transports kInproc{"inproc", {"inproc", "inproc", "inproc", "inproc"}};
const Transports kFast{"fastdds", {"fastdds", "fastdds", "fastdds", "fastdds"}};
const Transports kCyclone{"cyclonedds", {"cyclonedds", "cyclonedds", "cyclonedds", "cyclonedds"}};
const Transports kMixed{"mixed", {"fastdds", "fastdds", "cyclonedds", "cyclonedds"}};

#ifdef ROCI_ALL_TRANSPORTS
const std::vector<Transports> kTransports{kFast, kCyclone, kMixed};
#else
const std::vector<Transports> kTransports{kInproc, kCyclone};
#endif

class TwoRoversInTheYard : public testing::TestWithParam<Transports> {};

TEST_P(TwoRoversInTheYard, TheScoutsMapKeepsThePrimaryOutOfTheTrap) {
  Yard yard("nominal", GetParam().vendors, scout_first(true));
  yard.run();
  const auto& words = yard.words();
  ASSERT_GE(words.size(), 4U);
  EXPECT_EQ(words[0].code, "no-go") << words[0].reason;
  EXPECT_THAT(words[0].reason, HasSubstr("No-Go for primary"));
  EXPECT_EQ(words[1].stage, v1::STAGE_COMPLETED);
  EXPECT_EQ(words[1].results.at("obstacles"), 1);
  const YardWord& primary = words.back();
  EXPECT_EQ(primary.stage, v1::STAGE_COMPLETED) << primary.code << ": " << primary.reason;
  EXPECT_EQ(primary.results.at("sinkage"), 0) << "it never stood in the trap";
  EXPECT_THAT(yard.events(), Contains(HasSubstr("primary.path map.patch_taken")));
  EXPECT_THAT(yard.events(), Contains(HasSubstr("sim_svc soil.no_go scout says No-Go for primary")));

  Yard again("nominal", kInproc.vendors, scout_first(true));
  again.run();
  EXPECT_EQ(yard.trace(), again.trace()) << "one seed, one trace, whatever carries it";
}

TEST_P(TwoRoversInTheYard, WithoutThePatchThePrimaryIsDugIn) {
  Yard yard("nominal", GetParam().vendors, scout_first(false));
  yard.run();
  const YardWord& primary = yard.words().back();
  EXPECT_EQ(primary.code, "bogged-down");
  EXPECT_GT(primary.results.at("sinkage"), 0.1);
  EXPECT_THAT(yard.events(), Not(Contains(HasSubstr("primary.path map."))));
}

INSTANTIATE_TEST_SUITE_P(Transports, TwoRoversInTheYard, testing::ValuesIn(kTransports),
                         [](const auto& one) { return one.param.name; });

#ifndef ROCI_ALL_TRANSPORTS

TEST(YardSenses, ThePrimarySeesTheScoutBeforeItAndNotBesideIt) {
  Yard yard("nominal", kInproc.vendors, [](const std::vector<YardWord>& words) -> std::optional<YardCommand> {
    switch (words.size()) {
      case 0:
        return localise();
      case 1:
        return turn("primary", 5, 20);
      case 2:
        return localise();
      case 3:
        return turn("primary", 7, 15);
      case 4:
        return localise();
      default:
        return std::nullopt;
    }
  });
  yard.run();
  const auto& words = yard.words();
  ASSERT_EQ(words.size(), 5U);
  EXPECT_EQ(words[0].stage, v1::STAGE_COMPLETED) << words[0].reason;
  EXPECT_NEAR(words[0].results.at("x"), 7, 0.3);
  EXPECT_NEAR(words[0].results.at("y"), 15, 0.3);
  EXPECT_EQ(words[2].code, "marker-not-seen");
  EXPECT_THAT(words[2].reason, HasSubstr("field of view"));
  EXPECT_EQ(words[4].stage, v1::STAGE_COMPLETED) << words[4].reason;
}

sim::world::Ground true_ground(const std::string& scenario = "nominal") {
  sim::world::Ground ground =
      sim::scenario::load_run(ROCI_SOURCE_DIR "/missions/faster", scenario, sim::components::standard_types())
          .world.ground;
  sim::world::scatter(ground.surface.soil, 1);
  return ground;
}

const TrueLimits kPrimary{0.8, 15, 0.1, {2354, 6, 0.1, 0.3}};

TEST(TrueWay, ThereIsOneAroundTheTrapAndItIsLongerThanTheStraightOne) {
  const sim::world::Ground ground = true_ground();
  const auto way = true_way(ground, kPrimary, {5, 15}, {20, 15});
  ASSERT_TRUE(way);
  EXPECT_GT(way->length_m, 15.5);
  EXPECT_LT(way->length_m, 22);
  for (const terrain::Point p : way->points) EXPECT_FALSE(no_go_at(ground, kPrimary.vehicle, p));
  TrueLimits light = kPrimary;
  light.vehicle = {177, 4, 0.06, 0.4};
  EXPECT_LT(true_way(ground, light, {5, 15}, {20, 15})->length_m, way->length_m) << "the scout may cross it";
}

TEST(TrueWay, SoilFromEdgeToEdgeLeavesNone) {
  sim::world::Ground ground = true_ground();
  ground.surface.soil.areas.push_back({"trap", {}, 0, {{{12, -1}, {13, -1}, {13, 31}, {12, 31}}}});
  EXPECT_FALSE(true_way(ground, kPrimary, {5, 15}, {20, 15}));
  EXPECT_FALSE(true_way(true_ground(), kPrimary, {5, 15}, {11, 15})) << "the goal lies in the trap";
}

#endif

}  // namespace
}  // namespace roci::scenario
