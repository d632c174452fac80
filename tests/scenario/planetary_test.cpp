// The planetary mission, flown by every service as a process of its own over each transport.
#include <gtest/gtest.h>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

const std::string kMission = std::string(ROCI_SOURCE_DIR) + "/missions/planetary";

class PlanetaryTest : public ::testing::TestWithParam<const char*> {};

TEST_P(PlanetaryTest, NominalAchievesItsThreeGoals) {
  const Flight flight = fly(kMission, GetParam());
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved") << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", 0), 3);
  EXPECT_EQ(flight.summary.value("dds", ""), GetParam());
  EXPECT_LT(flight.summary["planner"].value("max_s", 1e9), 1.0);  // R58
}

TEST_P(PlanetaryTest, TheSameSeedGivesTheTraceOfTheReference) {
  static const std::string reference = fly(kMission, "inproc").summary.value("trace_sha256", "no trace");
  EXPECT_EQ(fly(kMission, GetParam()).summary.value("trace_sha256", ""), reference);
}

INSTANTIATE_TEST_SUITE_P(Transports, PlanetaryTest,
                         ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

TEST(PlanetaryTraceTest, AnotherSeedGivesAnotherTrace) {
  const std::string one = fly(kMission, "inproc", 1).summary.value("trace_sha256", "");
  const std::string two = fly(kMission, "inproc", 2).summary.value("trace_sha256", "");
  EXPECT_EQ(one.size(), 64U);
  EXPECT_NE(one, two);
}

// A fifth of the best-effort samples lost, the rest 3 ms late.
TEST(PlanetaryTraceTest, ABadNetworkChangesNothing) {
  const Ended ended = run("ROCI_LOSS=0.2:7:3 roci-launch " + kMission +
                          " --dds mixed --seed 1 --speed max --headless --json");
  const std::string reference = fly(kMission, "inproc", 1).summary.value("trace_sha256", "no trace");
  EXPECT_EQ(last_line_as_json(ended.output).value("trace_sha256", ""), reference);
}

TEST(PlanetaryTraceTest, AnUnknownMissionIsAMistakeOfTheUser) {
  const Ended ended = run("roci-launch no-such-mission --speed max --headless --json 2>&1");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.output.find("no-such-mission"), std::string::npos);
}

}  // namespace
}  // namespace roci::scenario
