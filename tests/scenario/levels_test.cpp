// Levels of autonomy E1 to E3 and the cycle of SanchoExpress (R128, R129), by the programs that users start. E4 is
// flown by porter_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;

constexpr char kPorter[] = ROCI_SOURCE_DIR "/tests/missions/porter";

class Levels : public ::testing::TestWithParam<const char*> {
 protected:
  ~Levels() override {
    fs::remove_all(folder_);
    fs::remove_all(mission_);
  }

  // Each has the events that its scenario lists, and the same trace on every transport.
  void expect_as_listed(const std::string& scenario, const std::string& mission = kPorter) {
    const Flight flight =
        fly(mission, GetParam(), 1, "--scenario " + scenario + " --run-folder " + folder_.string());
    EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
    if (GetParam() != std::string("inproc")) {
      EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(mission, "--scenario " + scenario));
    }
  }

  // What was begun, with its time in seconds: "15 drive dock gate".
  std::vector<std::string> timed_deeds() const {
    std::vector<std::string> out;
    std::ifstream in(folder_ / "effects.jsonl");
    for (std::string line; std::getline(in, line);) {
      const json deed = json::parse(line);
      out.push_back(std::to_string(deed["time_us"].get<long>() / 1'000'000) + " " + deed.value("kind", "") +
                    " " + deed.value("object", ""));
    }
    return out;
  }

  // The porter with another setting of its executive, on which no order of the scenario is put.
  std::string with_executive(const std::string& setting) const {
    fs::create_directories(mission_);
    fs::copy(kPorter, mission_, fs::copy_options::recursive);
    edit(mission_ / "scenarios/e2.yaml", "  - {at_s: 1, order: {id: level, kind: autonomy, level: E2}}\n",
         "");
    edit(mission_ / "mission.yaml", "executive: {", "executive: {" + setting + ", ");
    edit(mission_ / "porter.yaml", "horizon_s: 7200", "horizon_s: 1000");
    return mission_.string();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_levels_" + std::to_string(::getpid()));
  const fs::path mission_ = fs::temp_directory_path() / ("roci_levels_mission_" + std::to_string(::getpid()));
};

TEST_P(Levels, AtE1TheGroundLetsEachCommandStart) {
  expect_as_listed("e1");
  EXPECT_THAT(timed_deeds(),
              ElementsAre("100 drive dock gate", "200 lift red", "300 drive gate dock", "400 set_down red"));
}

// The drive may last 132 s, the lift 60 s: what ends sooner is waited for.
TEST_P(Levels, AtE2EachCommandStartsAtItsPlannedTime) {
  expect_as_listed("e2");
  EXPECT_THAT(timed_deeds(),
              ElementsAre("15 drive dock gate", "147 lift red", "207 drive gate dock", "339 set_down red"));
}

TEST_P(Levels, AtE2WhatDoesNotHoldItsTimeBreaksThePlan) { expect_as_listed("e2_late"); }

TEST_P(Levels, TheMissionNamesTheLevelWithWhichItBegins) {
  expect_as_listed("e2", with_executive("autonomy: E2"));
  EXPECT_THAT(timed_deeds(),
              ElementsAre("15 drive dock gate", "147 lift red", "207 drive gate dock", "339 set_down red"));
}

// R129: what cannot be repaired within the plan's times waits for the ground; R149: the ground launches the plan again.
TEST_P(Levels, AtE3AFailureWaitsForTheGround) {
  expect_as_listed("e3");
  EXPECT_THAT(timed_deeds(), ElementsAre("15 drive dock gate", "36 lift red", "46 drive gate dock",
                                         "500 drive gate dock", "520 set_down red"));
}

// R129: the planner is behind a link; each plan begins at its origin, five seconds after the request, and nothing moves
// between the plans.
TEST_P(Levels, PlansGoUpAndBeginAtTheirOrigins) {
  expect_as_listed("cycle");
  const std::vector<std::string> deeds = timed_deeds();
  ASSERT_EQ(deeds.size(), 10U);
  EXPECT_EQ(deeds[0], "15 drive dock gate");
  EXPECT_EQ(deeds[3], "65 set_down red");
  EXPECT_EQ(deeds[4], "605 drive dock gate");
}

// R129, R144: the other start policy. All is over 1000 s after the origin at the latest, whatever may last its longest.
TEST_P(Levels, AMissionMayStartAsLateAsItMay) {
  expect_as_listed("e2", with_executive("autonomy: E3, start: latest"));
  EXPECT_THAT(timed_deeds(),
              ElementsAre("631 drive dock gate", "763 lift red", "823 drive gate dock", "955 set_down red"));
}

INSTANTIATE_TEST_SUITE_P(Transports, Levels, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

class Idling : public ::testing::TestWithParam<const char*> {
 protected:
  ~Idling() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::temp_directory_path() / ("roci_idling_" + std::to_string(::getpid()));
};

// R129: idle from the plan's end to the next plan. What the plan has brought about on a timeline that nobody observes
// is told like an observation (R135), also by an executive that was killed meanwhile and plans on from there.
TEST_P(Idling, IsShownWithWhatThePlanHasBroughtAbout) {
  const services::process::DomainClaim domain;
  const Ended ended =
      run(ROCI_SOURCE_DIR "/tests/scenario/idle.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
          std::string(kPorter) + " " + GetParam() + " " + std::to_string(domain.id()) + " " +
          folder_.string() + " errand --scenario cycle --speed 60");
  std::vector<json> lines;
  std::istringstream text(ended.output);
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line, nullptr, false));
  ASSERT_EQ(lines.size(), 3U) << ended.output;
  for (const json& status : {lines[0], lines[1]}) {
    ASSERT_TRUE(status.is_object()) << ended.output;
    EXPECT_EQ(status["idle"]["after_plan"], 1) << status;
    EXPECT_EQ(status["idle"]["outcome"], "finished");
    EXPECT_EQ(status["timelines"]["errand"], "fetched red");
    EXPECT_EQ(status["phase"], "finished");
  }
  EXPECT_EQ(lines[2].value("result", ""), "achieved") << ended.output;
}

INSTANTIATE_TEST_SUITE_P(Vendors, Idling, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
