// A mission whose plans are hierarchical timelines (QuijoteExpress): no PDDL, no network of tasks.
// By the programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "services/process/domain_claim.hpp"
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
    const std::string mission = ROCI_SOURCE_DIR "/tests/missions/" + mission_;
    const Flight flight =
        fly(mission, GetParam(), 1, "--scenario " + scenario + " --run-folder " + folder_.string());
    EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
    if (GetParam() != std::string("inproc")) {
      EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(mission, "--scenario " + scenario));
    }
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

// The planning request carries the windows of the mission: each communication is planned inside of one, the earliest
// that fits, in one plan. The executive does not send a message before, though nothing else is in its way.
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

// The plan would begin half a second after the window has closed: what was seen when it was asked for does not count.
TEST_P(Relay, AWindowThatClosesBeforeThePlanBeginsIsNotCountedOn) {
  expect_as_listed("closing");
  EXPECT_THAT(sent(), ElementsAre(testing::Pair(600, "log")));
}

TEST_P(Relay, AWindowThatOpensBeforeItIsPredictedIsUsedAndMayCloseTooSoon) {
  expect_as_listed("early");
  const auto messages = sent();
  ASSERT_FALSE(messages.empty());
  EXPECT_THAT(messages.back(), testing::Pair(600, "weather"));
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

/// Is the porter whose ways are a service's to know: the same mission on the planetary site, with a path planner.
class PorterWithAPathPlanner : public ::testing::TestWithParam<const char*> {
 protected:
  PorterWithAPathPlanner() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/porter", mission_, fs::copy_options::recursive);
    edit(mission_ / "porter.yaml",
         "metres: {arguments: [place, place], symmetric: true, rows: [[dock, gate, 6], [gate, yard, 10]]}",
         "drive_s: {arguments: [place, place], asked: {module: pathplan, function: traverse_time, rows_of: "
         "path}}");
    edit(mission_ / "porter.yaml", "[\"metres(from, to) / 0.5\", \"metres(from, to) / 0.5 + 120\"]",
         "[\"0.5 * drive_s(from, to)\", \"2 * drive_s(from, to)\"]");
    edit(mission_ / "mission.yaml", "model: porter.yaml",
         "  - {name: pathplan_svc, robot: porter}\nmodel: porter.yaml\nsite: " ROCI_SOURCE_DIR
         "/missions/planetary/site/site.yaml\nobjects:\n"
         "  - {name: dock, type: place, properties: {x: 48, y: 40}}\n"
         "  - {name: gate, type: place, properties: {x: 60, y: 50}}\n"
         "  - {name: yard, type: place, properties: {x: 72, y: 58}}");
    edit(mission_ / "mission.yaml", "duration_s: 20,", "duration_s: 160,");
  }
  ~PorterWithAPathPlanner() override { fs::remove_all(folder_); }

  Flight flown(const std::string& dds) const {
    return fly(mission_.string(), dds, 1, "--run-folder " + run_folder().string());
  }
  fs::path run_folder() const { return folder_ / "run"; }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_asked_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "mission";
};

// R35, R36: how long a drive takes is asked of the path planner before the search, in one batch.
TEST_P(PorterWithAPathPlanner, PlansWithTheTimesThatItGives) {
  const Flight flight = flown(GetParam());
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(deeds_of(run_folder()).size(), 10U);
  const auto call = nlohmann::json::parse(text_of(run_folder() / "planner_calls/1.json"));
  EXPECT_EQ(call.value("function_requests", 0), 1);
  EXPECT_EQ(call.value("function_tuples", 0), 4) << "both ways between neighbours, and no other";
  EXPECT_THAT(text_of(run_folder() / "planner_calls/1.values"),
              ::testing::ContainsRegex("\\(traverse_time gate dock\\) 1[0-9]+\\.[0-9]+\n"));
  if (GetParam() != std::string("inproc")) {
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(mission_.string()));
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, PorterWithAPathPlanner,
                         ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

class PorterOnOneVendor : public PorterWithAPathPlanner {};

TEST_P(PorterOnOneVendor, AGoalThatIsOutOfReachFailsInThePathPlannersWords) {
  edit(mission_ / "mission.yaml", "x: 72, y: 58", "x: 190, y: 60");
  const Flight flight = flown(GetParam());
  EXPECT_EQ(flight.summary["goals"].value("achieved", 0), 1) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("failed", 0), 1);
  EXPECT_THAT(journaled_events(run_folder() / "journal.sqlite"),
              ::testing::Contains("goal.failed hard goal ground/blue failed: out of reach: yard (x=190 y=60) "
                                  "is unreachable (says pathplan_svc, traverse_time, model 1); the ground "
                                  "is asked"));
}

// `roci plan --why` while it flies.
TEST_P(PorterOnOneVendor, AnOperatorSeesWhoGaveTheValue) {
  const services::process::DomainClaim domain;
  const std::string where = std::string(" --dds ") + GetParam() + " --domain " + std::to_string(domain.id());
  const Ended ended =
      run("timeout 100 roci-launch " + mission_.string() + where +
          " --speed 60 --headless --json > /dev/null 2>&1 & launcher=$!\n"
          "until timeout 40 roci" +
          where +
          " plan --why 'base.driving(gate, dock)' --json 2> /dev/null; do kill -0 $launcher || break; done\n"
          "kill $launcher; wait $launcher");
  const auto drives = nlohmann::json::parse(ended.output, nullptr, false);
  ASSERT_TRUE(drives.is_array() && !drives.empty()) << ended.output;
  for (const auto& drive : drives) {
    ASSERT_EQ(drive["function_values"].size(), 1U) << drive;
    const auto& value = drive["function_values"][0];
    EXPECT_EQ(value.value("function", ""), "traverse_time");
    EXPECT_EQ(value.value("owner", ""), "pathplan_svc");
    EXPECT_EQ(value.value("accuracy", ""), "exact");
    EXPECT_EQ(value.value("model_version", 0), 1);
    EXPECT_GT(value.value("value", 0.0), 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, PorterOnOneVendor, ::testing::Values("cyclonedds"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
