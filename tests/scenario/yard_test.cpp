// Two rovers before a sand trap that no map shows: the scout finds it, its map goes to the primary, and both go around;
// in the same flight without the patch the primary stands before it. No planner and no executive: a script commands.
#include "tests/scenario/yard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenario/true_way.hpp"

namespace roci::scenario {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr int kMostNoGo = 12;  // after which a flight gives up
constexpr terrain::Point kStart = kYardStart, kTarget = kYardTarget;

// As the paper has it: the way is the primary's, the scout drives it first, from way-point to way-point. After a No-Go
// the scout's map is told, and there is another way. Where the scout came through, the primary follows.
class ScoutFirst {
 public:
  std::optional<YardCommand> operator()(const std::vector<YardWord>& words) {
    switch (phase_) {
      case Phase::begin:
        return ask();
      case Phase::path:
        if (words.back().way.empty()) return std::nullopt;
        way_ = words.back().way;
        next_ = 1;
        phase_ = Phase::scout;
        return scout();
      case Phase::scout:
        if (words.back().code == "no-go" && ++tries_ <= kMostNoGo) {
          phase_ = Phase::tell;
          return tell("scout");
        }
        if (words.back().stage != v1::STAGE_COMPLETED) return std::nullopt;
        if (next_ < way_.size()) return scout();
        phase_ = Phase::primary;
        return drive("primary", kTarget.x, kTarget.y);
      case Phase::tell:
        return ask();
      case Phase::primary:
        break;
    }
    return std::nullopt;
  }

 private:
  enum class Phase { begin, path, scout, tell, primary };
  YardCommand ask() {
    phase_ = Phase::path;
    return path("primary", kStart, kTarget);
  }
  YardCommand scout() {
    const terrain::Point to = way_[next_++];
    return drive("scout", to.x, to.y);
  }

  Phase phase_ = Phase::begin;
  std::vector<terrain::Point> way_;
  std::size_t next_ = 0;
  int tries_ = 0;
};

// The scout finds the trap and keeps it to itself.
std::optional<YardCommand> without_a_word(const std::vector<YardWord>& words) {
  if (words.empty()) return drive("scout", 21.5, 15);
  if (words.size() == 1) return drive("primary", kTarget.x, kTarget.y);
  return std::nullopt;
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
  Yard yard("yard", GetParam().vendors, ScoutFirst{});
  yard.run();
  const auto& words = yard.words();
  ASSERT_GE(words.size(), 4U);
  const auto found = std::ranges::find(words, "no-go", &YardWord::code);
  ASSERT_TRUE(found != words.end() && found + 2 < words.end());
  EXPECT_THAT(found->reason, HasSubstr("No-Go for primary"));
  const YardWord& told = *(found + 1);
  EXPECT_EQ(told.stage, v1::STAGE_COMPLETED);
  EXPECT_EQ(told.results.at("obstacles"), 1);
  EXPECT_NE((found + 2)->way, words[0].way) << "another way than before";
  const YardWord& primary = words.back();
  EXPECT_EQ(primary.stage, v1::STAGE_COMPLETED) << primary.code << ": " << primary.reason;
  EXPECT_EQ(primary.results.at("sinkage"), 0) << "it never stood in the trap";
  EXPECT_THAT(yard.events(), Contains(HasSubstr("primary.path map.patch_taken")));
  EXPECT_THAT(yard.events(), Contains(HasSubstr("sim_svc soil.no_go scout says No-Go for primary")));

  Yard again("yard", kInproc.vendors, ScoutFirst{});
  again.run();
  EXPECT_EQ(yard.trace(), again.trace()) << "one seed, one trace, whatever carries it";
}

// Nobody has told it, but its own front wheels feel the soil before its weight is in it.
TEST_P(TwoRoversInTheYard, WithoutThePatchThePrimaryFeelsTheTrapAndStands) {
  Yard yard("yard", GetParam().vendors, without_a_word);
  yard.run();
  const YardWord& primary = yard.words().back();
  EXPECT_EQ(primary.code, "no-go");
  EXPECT_THAT(primary.reason, HasSubstr("front wheel says No-Go for primary"));
  EXPECT_EQ(primary.results.at("sinkage"), 0) << "it never stood in the trap";
  EXPECT_THAT(yard.events(), Not(Contains(HasSubstr("primary.path map.patch_taken"))));
}

// The scout drives what the primary would drive, point by point;
// what it has found is merged before the primary's next path.
TEST_P(TwoRoversInTheYard, TheScoutDrivesThePrimarysWayAndItsMapIsMerged) {
  const auto script = [](const std::vector<YardWord>& words) -> std::optional<YardCommand> {
    switch (words.size()) {
      case 0:
        return path("primary", kStart, kTarget);
      case 1:
        return drive_over("scout", {words[0].way.begin() + 1, words[0].way.end()});
      case 2:
        return tell("scout");
      case 3:
        return merge("primary", "scout.path", words[2].results.at("map_version"));
      case 4:
        return path("primary", kStart, kTarget);
      case 5:
        return merge("primary", "scout.path", words[2].results.at("map_version") + 1);
      case 6:
        return merge("primary", "primary.path", 1);
      case 7:
        return drive_over("scout", {{7, 15}, {99, 15}});
      default:
        return std::nullopt;
    }
  };
  Yard yard("yard", GetParam().vendors, script);
  yard.run();
  const auto& words = yard.words();
  ASSERT_EQ(words.size(), 8U);
  EXPECT_EQ(words[1].code, "no-go") << words[1].reason;
  EXPECT_EQ(words[3].stage, v1::STAGE_COMPLETED) << words[3].code << ": " << words[3].reason;
  EXPECT_EQ(words[3].results.at("author_version"), words[2].results.at("map_version"));
  EXPECT_EQ(words[3].results.at("obstacles"), 1);
  EXPECT_NE(words[4].way, words[0].way) << "another way than before";
  EXPECT_EQ(words[5].code, "patch-missing");
  EXPECT_THAT(words[5].reason, HasSubstr("scout.path with version"));
  EXPECT_EQ(words[6].code, "unknown-author");
  EXPECT_EQ(words[7].code, "bad-arguments");
  EXPECT_THAT(words[7].reason, HasSubstr("point 2 (99,15) lies off the map"));

  Yard again("yard", kInproc.vendors, script);
  again.run();
  EXPECT_EQ(yard.trace(), again.trace()) << "one seed, one trace, whatever carries it";
}

INSTANTIATE_TEST_SUITE_P(Transports, TwoRoversInTheYard, testing::ValuesIn(kTransports),
                         [](const auto& one) { return one.param.name; });

#ifndef ROCI_ALL_TRANSPORTS

TEST(YardSenses, ThePrimarySeesTheScoutBeforeItAndNotBesideIt) {
  Yard yard("yard", kInproc.vendors, [](const std::vector<YardWord>& words) -> std::optional<YardCommand> {
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

#endif

sim::world::Ground yard_ground(const std::string& scenario = "yard", std::uint64_t seed = 1) {
  return true_ground(ROCI_SOURCE_DIR "/missions/faster", scenario, seed);
}

const TrueLimits kPrimary = kYardPrimary;

#ifdef ROCI_ALL_TRANSPORTS
constexpr std::uint64_t kSeeds = 200;
#else
constexpr std::uint64_t kSeeds = 40;
#endif

// Traps where the seed puts them: where a way exists on the true map the primary gets there, and it is never dug in.
TEST(HiddenTraps, WhereAWayExistsThePrimaryFindsIt) {
  int exist = 0, reached = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Yard yard("hidden", kInproc.vendors, ScoutFirst{}, seed);
    yard.run();
    const YardWord& primary = yard.words().back();
    EXPECT_NE(primary.code, "bogged-down") << "seed " << seed;
    const bool way = true_way(yard_ground("hidden", seed), kPrimary, kStart, kTarget).has_value();
    exist += way ? 1 : 0;
    reached += way && primary.stage == v1::STAGE_COMPLETED ? 1 : 0;
  }
  EXPECT_GT(exist, static_cast<int>(kSeeds) / 2);
  EXPECT_GE(reached, 0.95 * exist) << exist << " ways exist";
}

#ifndef ROCI_ALL_TRANSPORTS

TEST(TrueWay, ThereIsOneAroundTheTrapAndItIsLongerThanTheStraightOne) {
  const sim::world::Ground ground = yard_ground();
  const auto way = true_way(ground, kPrimary, kStart, kTarget);
  ASSERT_TRUE(way);
  EXPECT_GT(way->length_m, 15.5);
  EXPECT_LT(way->length_m, 22);
  for (const terrain::Point p : way->points) EXPECT_FALSE(no_go_at(ground, kPrimary.vehicle, p));
  TrueLimits light = kPrimary;
  light.vehicle = {177, 4, 0.06, 0.4};
  EXPECT_LE(true_way(ground, light, kStart, kTarget)->length_m, way->length_m) << "the scout may cross it";
}

TEST(TrueWay, SoilFromEdgeToEdgeLeavesNone) {
  sim::world::Ground ground = yard_ground();
  ground.surface.soil.areas.push_back({"trap", {}, 0, {{{12, -1}, {13, -1}, {13, 31}, {12, 31}}}});
  EXPECT_FALSE(true_way(ground, kPrimary, kStart, kTarget));
  EXPECT_FALSE(true_way(yard_ground(), kPrimary, {5, 15}, {11, 15})) << "the goal lies in the trap";
}

#endif

}  // namespace
}  // namespace roci::scenario
