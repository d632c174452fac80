// What the two rovers do when a service of theirs is missing or dies: the finder of odd things (R128, level E5), and
// the executive while a decision of the plan is open (R131).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::Contains, ::testing::Each, ::testing::HasSubstr, ::testing::Not, ::testing::StartsWith;

class FasterFailures : public ::testing::Test {
 protected:
  FasterFailures() {
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/faster", mission_, fs::copy_options::recursive);
  }
  ~FasterFailures() override { fs::remove_all(folder_); }

  // "scout w1", in order.
  std::vector<std::string> motions() const {
    std::vector<std::string> out;
    std::istringstream lines(text_of(folder_ / "run/effects.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const json deed = json::parse(line);
      if (deed["kind"] == "motion")
        out.push_back(deed["robot"].get<std::string>() + " " + deed["object"].get<std::string>());
    }
    return out;
  }
  void expect_arrived(const json& summary) const {
    EXPECT_EQ(summary.value("result", ""), "achieved") << summary;
    EXPECT_THAT(motions(), Contains("scout w9"));
    EXPECT_EQ(motions().back(), "primary w9");
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_faster_failures_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "faster";
};

// The stone lies there, and nobody looks for it: the trial is flown as if it were not there.
TEST_F(FasterFailures, WithoutTheFinderTheTrialIsFlown) {
  edit(mission_ / "mission.yaml", "  - {name: science_svc, robot: primary, essential: false}", "  #");
  edit(mission_ / "scenarios/opportunity.yaml",
       "  - science.find\n  - goal.accepted: find-e8n19\n"
       "  - plan.adopted: for long_traverse, last_communication, find-e8n19\n"
       "  - goal.achieved: find-e8n19\n",
       "");
  const Flight flight = fly(mission_.string(), "inproc", 1,
                            "--scenario opportunity --run-folder " + (folder_ / "run").string());
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(flight.summary["replans"], 0);
  expect_arrived(flight.summary);
}

// It is no part without which the rovers would have to stand: while it is away they go on,
// and both goals of the ground are achieved.
TEST_F(FasterFailures, AFinderThatDiesEndsNothing) {
  const Ended ended =
      run(ROCI_SOURCE_DIR "/tests/scenario/kill_in_flight.sh ${PATH%%:*} " + mission_.string() + " fastdds " +
          (folder_ / "run").string() + " science_svc w1 --scenario opportunity --speed 400");
  EXPECT_THAT(ended.output, StartsWith("killed science_svc"));
  const json summary = last_line_as_json(ended.output);
  expect_arrived(summary);
  const auto events = journaled_events(folder_ / "run/journal.sqlite");
  EXPECT_THAT(events, Contains(HasSubstr("long_traverse achieved")));
  EXPECT_THAT(events, Contains(HasSubstr("last_communication achieved")));
  EXPECT_THAT(events, Each(Not(StartsWith("plan.broken"))));
}

struct Death {
  const char* name;
  const char* dds;
  const char* at;
  const char* more;
  int epoch;  // in which the mission ends
};

class FasterDecisions : public FasterFailures, public ::testing::WithParamInterface<Death> {};

// Whether the primary follows is asked of the engine that has planned it, in each of nine cycles. The executive dies
// when it has asked; the next one hears one answer to that question, takes it once, and the journal has it.
TEST_P(FasterDecisions, OfTheEngineAreAnsweredOnceAcrossADeath) {
  edit(mission_ / "behaviours.yaml", "        resolver: rule\n        before: follow.start",
       "        resolver: engine\n        before: follow.start");
  const Ended ended = run("ROCI_CRASH=" + std::string(GetParam().at) + " roci-launch " + mission_.string() +
                          " --scenario trial --dds " + GetParam().dds + GetParam().more +
                          " --speed max --headless --json --run-folder " + (folder_ / "run").string());
  const json summary = last_line_as_json(ended.output);
  expect_arrived(summary);
  EXPECT_EQ(summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(summary.value("epoch", 0), GetParam().epoch);
  EXPECT_EQ(summary["replans"], 0);

  std::map<std::string, int> asked, taken;
  std::istringstream lines(
      run("roci-trace print " + (folder_ / "run" / summary.value("journal", "")).string()).output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string time, kind, first, second, third;
    words >> time >> kind >> first >> second >> third;
    if (kind == "decision" && third == "state=0") ++asked[first];
    if (kind == "answered" && first.starts_with("timeline_htn/") && third == "outcome=0") ++taken[second];
  }
  EXPECT_EQ(taken.size(), 9U);
  EXPECT_EQ(taken, asked);
  for (const auto& [decision, times] : taken) EXPECT_EQ(times, 1) << decision;
}

INSTANTIATE_TEST_SUITE_P(
    Deaths, FasterDecisions,
    ::testing::Values(Death{"killed", "fastdds", "after-question:2,after-question:1,after-question:1", "", 4},
                      Death{"taken_over", "cyclonedds", "after-question:2", " --standby", 2}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
