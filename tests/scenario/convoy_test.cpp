// One executive commands two rovers through dedicated executives (R128, R145, R146), by the programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
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
using ::testing::Contains, ::testing::ElementsAre, ::testing::HasSubstr, ::testing::Not,
    ::testing::StartsWith;

constexpr char kMission[] = ROCI_SOURCE_DIR "/tests/missions/convoy";

class Convoy : public ::testing::TestWithParam<const char*> {
 protected:
  ~Convoy() override { fs::remove_all(folder_); }

  // Each has the events that its scenario lists, and the same trace on every transport.
  void expect_as_listed(const std::string& scenario) {
    const Flight flight =
        fly(kMission, GetParam(), 1, "--scenario " + scenario + " --run-folder " + folder_.string());
    EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
    if (GetParam() != std::string("inproc")) {
      EXPECT_EQ(flight.summary.value("trace_sha256", ""),
                reference_trace(kMission, "--scenario " + scenario));
    }
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_convoy_" + std::to_string(::getpid()));
};

TEST_P(Convoy, TheScoutTriesEachStretchAndThePrimaryFollows) {
  expect_as_listed("nominal");
  EXPECT_THAT(deeds_of(folder_),
              ElementsAre("drive w1", "press w1", "drive w1", "drive w2", "press w2", "drive w2"));
}

TEST_P(Convoy, ARepairIsInvisibleAbove) {
  expect_as_listed("repaired");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("drive w1", "back_off ", "drive w1", "press w1", "drive w1",
                                             "drive w2", "press w2", "drive w2"));
}

TEST_P(Convoy, WhatCannotBeRepairedGoesUp) { expect_as_listed("escalated"); }

// R149, and trial_stopped of the paper: the running step is stopped by its own executive, both rovers rest, and the
// plan is launched again without the primary's last step, until the ground lets the robots plan anew.
TEST_P(Convoy, TheGroundStopsThePlanAndLaunchesItAgain) {
  expect_as_listed("trial_stopped");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("drive w1", "press w1", "drive w1", "drive w2", "drive w2",
                                             "press w2", "drive w2"));
}

// Level E2 (R128).
TEST_P(Convoy, APlanOfFixedTimesBreaksWhereAStepLastsLonger) { expect_as_listed("e2"); }

// Level E1 (R128): two rovers at a time, each with one commander.
TEST_P(Convoy, TheGroundCommandsSingleDecisions) {
  expect_as_listed("commanded");
  EXPECT_THAT(deeds_of(folder_),
              ElementsAre("drive w1", "press w1", "drive w1", "drive w2", "press w2", "drive w2"));
}

INSTANTIATE_TEST_SUITE_P(Transports, Convoy, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

class ConvoyReport : public ::testing::Test {
 protected:
  ~ConvoyReport() override { fs::remove_all(folder_); }
  const services::process::DomainClaim claim_;
  const std::string domain_ = std::to_string(claim_.id());  // other runs of this machine are not asked
  const fs::path folder_ = fs::temp_directory_path() / ("roci_convoy_report_" + std::to_string(::getpid()));
};

// R129, R144: what became of the plan comes back with real times and results.
TEST_F(ConvoyReport, ThePlanThatBrokeIsToldAsItWasExecuted) {
  const Ended ended =
      run(ROCI_SOURCE_DIR "/tests/scenario/executed_plan.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
          std::string(kMission) + " fastdds " + domain_ + " " + folder_.string() +
          " --scenario escalated --speed 15");
  const json plan = json::parse(ended.output, nullptr, false);
  ASSERT_TRUE(plan.is_object()) << ended.output;
  EXPECT_EQ(plan["outcome"], "broken");
  EXPECT_THAT(plan.value("reason", ""), HasSubstr("out of order"));
  ASSERT_EQ(plan["activities"].size(), 4U);
  const json& scouted = plan["activities"][0];
  EXPECT_EQ(scouted["state"], "failed");
  EXPECT_EQ(scouted["started_s"], 15);
  EXPECT_THAT(scouted.value("cause", ""), HasSubstr("press: fault"));
  EXPECT_TRUE(scouted["values"].contains("duration_s")) << scouted;
  EXPECT_FALSE(plan["activities"][1].contains("started_s"));
}

// What was stopped comes back, too.
TEST_F(ConvoyReport, ThePlanThatWasStoppedIsToldAsItWasExecuted) {
  const Ended ended =
      run(ROCI_SOURCE_DIR "/tests/scenario/executed_plan.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
          std::string(kMission) + " cyclonedds " + domain_ + " " + folder_.string() +
          " --scenario trial_stopped --speed 30");
  const json plan = json::parse(ended.output, nullptr, false);
  ASSERT_TRUE(plan.is_object()) << ended.output;
  EXPECT_EQ(plan["outcome"], "cancelled");
  ASSERT_EQ(plan["activities"].size(), 4U);
  EXPECT_EQ(plan["activities"][1]["state"], "succeeded");
  EXPECT_EQ(plan["activities"][2]["state"], "cancelled") << "the scout's second stretch";
  EXPECT_EQ(plan["activities"][2]["ended_s"], 190);
  EXPECT_FALSE(plan["activities"][3].contains("started_s"));
}

// E1: the console waits for what became of its command.
TEST_F(ConvoyReport, ACommandOfTheConsoleIsAnsweredWithWhatItBrought) {
  const Ended ended = run(
      ROCI_SOURCE_DIR "/tests/scenario/single_command.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
      std::string(kMission) + " fastdds " + domain_ + " " + folder_.string() + " scout Scout from=w0 to=w1");
  std::vector<std::string> lines;
  std::istringstream text(ended.output);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_GE(lines.size(), 3U) << ended.output;
  EXPECT_EQ(lines.back(), "0");
  const json result = json::parse(lines[lines.size() - 2], nullptr, false);
  ASSERT_TRUE(result.is_object()) << ended.output;
  EXPECT_EQ(result["id"], "p1.1-Scout");
  EXPECT_EQ(result["state"], "succeeded");
  EXPECT_TRUE(result.contains("energy_j")) << result;
}

class ConvoyKills : public ::testing::TestWithParam<const char*> {
 protected:
  ~ConvoyKills() override { fs::remove_all(folder_); }

  // Kills the scout's dedicated executive while its scout drives. What is done is done under one key once.
  void kill_in(const std::string& mission) {
    const Ended ended = run(
        ROCI_SOURCE_DIR "/tests/scenario/kill_in_flight.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
        mission + " " + GetParam() + " " + (folder_ / "run").string() +
        " \"dedicated_svc.*scout\" w1 --scenario nominal --speed 200");
    EXPECT_THAT(ended.output, StartsWith("killed "));
    EXPECT_EQ(last_line_as_json(ended.output).value("result", ""), "achieved") << ended.output;
    std::vector<std::string> keys;
    std::string line;
    for (std::istringstream lines(text_of(folder_ / "run/effects.jsonl")); std::getline(lines, line);) {
      const json deed = json::parse(line);
      keys.push_back(deed["activity"].get<std::string>() + deed["attempt"].dump() +
                     deed["commander"].get<std::string>());
    }
    std::ranges::sort(keys);
    EXPECT_TRUE(std::ranges::adjacent_find(keys) == keys.end());
    events_ = journaled_events(folder_ / "run/journal.sqlite");
  }

  fs::path folder_ = fs::temp_directory_path() / ("roci_convoy_kills_" + std::to_string(::getpid()));
  std::vector<std::string> events_;
};

// What it commanded is ended before anything new begins.
TEST_P(ConvoyKills, ADedicatedExecutiveThatDiesEndsWhatItHadBegun) {
  fs::create_directories(folder_);
  kill_in(kMission);
  EXPECT_THAT(events_, Contains(StartsWith("goal.achieved")));
}

// R145: where the executive waits for it, it goes on, and the plan above does not break.
TEST_P(ConvoyKills, ADedicatedExecutiveThatComesBackInTimeGoesOn) {
  fs::create_directories(folder_);
  fs::copy(kMission, folder_ / "convoy", fs::copy_options::recursive);
  std::string text = text_of(folder_ / "convoy/mission.yaml");
  const std::string before = "executive: {";
  const auto at = text.find(before);
  ASSERT_NE(at, std::string::npos);
  std::ofstream(folder_ / "convoy/mission.yaml") << text.insert(at + before.size(), "owner_return_s: 200, ");
  kill_in(folder_ / "convoy");
  EXPECT_THAT(events_, Contains(StartsWith("goal.achieved")));
  EXPECT_THAT(events_, Not(Contains(StartsWith("plan.broken"))));
  EXPECT_THAT(events_, Not(Contains(StartsWith("service.lost scout.locomotion"))));
  EXPECT_THAT(deeds_of(folder_ / "run"),
              ElementsAre("drive w1", "press w1", "drive w1", "drive w2", "press w2", "drive w2"));
}

INSTANTIATE_TEST_SUITE_P(Transports, ConvoyKills, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
