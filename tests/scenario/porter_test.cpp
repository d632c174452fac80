// A mission whose plans are hierarchical timelines (QuijoteExpress): no PDDL, no network of tasks. By the programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class ByTimelines : public ::testing::TestWithParam<const char*> {
 protected:
  explicit ByTimelines(std::string mission) : mission_(std::move(mission)) {}
  ~ByTimelines() override { fs::remove_all(folder_); }

  // Each has the events that its scenario lists, and the same trace on every transport.
  void expect_as_listed(const std::string& scenario) {
    static std::map<std::string, std::string> traces;
    const Flight flight = fly(ROCI_SOURCE_DIR "/tests/missions/" + mission_, GetParam(), 1,
                              "--scenario " + scenario + " --run-folder " + folder_.string());
    EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
    const std::string trace = flight.summary.value("trace_sha256", "");
    EXPECT_EQ(traces.emplace(mission_ + scenario, trace).first->second, trace);
  }

  const std::string mission_;

  const fs::path folder_ = fs::temp_directory_path() / ("roci_porter_" + std::to_string(::getpid()));
};

class Porter : public ByTimelines {
 protected:
  Porter() : ByTimelines("porter") {}
};

// A goal of the abstract layer counts when its state stands on the timeline that nobody but the executive knows (R135).
TEST_P(Porter, BringsWhatIsAskedForInOnePlan) {
  expect_as_listed("nominal");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("drive dock gate", "lift red", "drive gate dock", "set_down red",
                                             "drive dock gate", "drive gate yard", "lift blue",
                                             "drive yard gate", "drive gate dock", "set_down blue"));
}

TEST_P(Porter, PlansAnewFromWhereItStands) {
  expect_as_listed("broken");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("drive dock gate", "lift red", "drive gate dock",
                                             "drive gate dock", "set_down red"));
}

INSTANTIATE_TEST_SUITE_P(Transports, Porter, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

class Relay : public ByTimelines {
 protected:
  Relay() : ByTimelines("relay") {}

  // When each message was sent, in seconds, with its name.
  std::vector<std::pair<double, std::string>> sent() const {
    std::vector<std::pair<double, std::string>> out;
    std::ifstream in(folder_ / "effects.jsonl");
    for (std::string line; std::getline(in, line);) {
      const auto deed = nlohmann::json::parse(line);
      out.emplace_back(deed.at("time_us").get<double>() / 1e6, deed.value("object", ""));
    }
    return out;
  }
};

// The planning request carries the windows of the mission: each communication is planned inside of one, the earliest that fits, in
// one plan. The executive does not send a message before, though nothing else is in its way.
TEST_P(Relay, CommunicationsArePlannedInTheWindowsOfTheGround) {
  expect_as_listed("nominal");
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_THAT(messages[0], testing::Pair(600, "weather"));
  EXPECT_THAT(messages[1], testing::Pair(testing::AllOf(testing::Gt(645), testing::Le(666)), "image"));
  EXPECT_THAT(messages[2], testing::Pair(2000, "log"));
}

TEST_P(Relay, AWindowThatStaysClosedIsWaitedForAndTheNextOneIsPlannedWith) {
  expect_as_listed("closed");
  EXPECT_THAT(sent(), ElementsAre(testing::Pair(2000, "weather")));
}

TEST_P(Relay, WhereNoWindowIsLeftTheGoalFallsAtOnceWithTheReason) {
  expect_as_listed("too_late");
  EXPECT_THAT(sent(), ElementsAre(testing::Pair(600, "log")));
  const auto events = journaled_events(folder_ / "journal.sqlite");
  EXPECT_THAT(events, testing::Contains(testing::HasSubstr(
                          "goal ground/weather dropped: out of reach: mail.told(weather) comes about at")));
}

INSTANTIATE_TEST_SUITE_P(Transports, Relay, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

class Patrol : public ByTimelines {
 protected:
  Patrol() : ByTimelines("patrol") {}
};

// R141: the plan names the contingency, which is tried while another timeline runs on; the plan stays.
TEST_P(Patrol, AContingencyIsTriedBesideWhatRunsOn) {
  expect_as_listed("contingency");
  EXPECT_THAT(deeds_of(folder_),
              ElementsAre("drive camp ridge", "film ", "look ", "back_off ", "drive camp ridge", "look "));
}

TEST_P(Patrol, AContingencyThatDoesNotHelpBreaksThePlan) { expect_as_listed("no_help"); }

// R131: the plan holds both choices.
TEST_P(Patrol, WhichWayIsRightIsSeenWhenItIsDue) { expect_as_listed("night"); }

// R149: with every level of the plan, and its choice as it was made.
TEST_P(Patrol, AStoppedPlanOfSeveralLevelsGoesOn) {
  expect_as_listed("stopped");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("drive camp ridge", "film ", "light_up ", "light_up "));
}

INSTANTIATE_TEST_SUITE_P(Transports, Patrol, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
