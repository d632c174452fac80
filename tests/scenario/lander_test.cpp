// A mission whose plans come from a task network (MEXEC): no PDDL, no map. The utility-driven engine plans all the
// time, through the programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::Not, ::testing::UnorderedElementsAre;

class Lander : public ::testing::TestWithParam<const char*> {
 protected:
  ~Lander() override { fs::remove_all(folder_); }

  Flight launch(const std::string& scenario) const {
    return fly(ROCI_SOURCE_DIR "/tests/missions/lander", GetParam(), 1,
               "--scenario " + scenario + " --run-folder " + folder_.string());
  }

  std::vector<std::string> deeds() const { return deeds_of(folder_); }

  // The record of a flight is enough to plan each of its cycles again, version for version.
  void expect_that_every_cycle_is_planned_again_alone() const {
    const Ended again = run("roci-network cycle " + (folder_ / "planner_steps/1.steps").string() + " --json");
    EXPECT_EQ(again.exit_code, 0) << again.output;
    const auto told = nlohmann::json::parse(again.output, nullptr, false);
    ASSERT_TRUE(told.is_object()) << again.output;
    EXPECT_GT(told["versions"], 5);
    EXPECT_EQ(told["differing"], 0);
    EXPECT_EQ(told["faulty"], 0);
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("roci_lander_" + std::to_string(::getpid()));
};

TEST_P(Lander, DoesAllThatItsBatteryAllows) {
  const Flight flight = launch("nominal");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_THAT(deeds(), UnorderedElementsAre("dig near", "image near", "send near", "dig far", "image far",
                                            "send far", "image horizon", "send view", "farewell "));
}

TEST_P(Lander, ChoosesTheBetterSiteWhereTheBatteryAllowsOne) {
  const Flight flight = launch("low");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_THAT(deeds(), Contains("send near"));
  EXPECT_THAT(deeds(), Not(Contains("dig far")));
  EXPECT_THAT(deeds(), Contains("farewell "));
}

TEST_P(Lander, TriesAgainWhatFailed) {
  const Flight flight = launch("broken");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_THAT(deeds(), Contains("send near"));
  EXPECT_THAT(deeds(), Contains("send far"));
  expect_that_every_cycle_is_planned_again_alone();
}

INSTANTIATE_TEST_SUITE_P(Transports, Lander, ::testing::Values("inproc", "fastdds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
