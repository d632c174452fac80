// The two rovers of missions/faster by the programs that users start: the trial, and what its table of scenarios says
// (R128, R137–R140, R145–R149).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::HasSubstr, ::testing::Not, ::testing::StartsWith;

struct Row {
  const char* scenario;
  const char* transport;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.scenario << ' ' << row.transport; }

class Faster : public ::testing::TestWithParam<Row> {
 protected:
  ~Faster() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_faster_" + std::to_string(::getpid()));
};

// The events come in the order that the scenario lists, with the same trace on every transport; both rovers end whole,
// and no primary was in soil that does not bear it.
TEST_P(Faster, FliesAsListed) {
  const auto [scenario, transport] = GetParam();
  const std::string mission = ROCI_SOURCE_DIR "/missions/faster",
                    flown = std::string("--scenario ") + scenario;
  const Flight flight = fly(mission, transport, 1, flown + " --run-folder " + folder_.string());
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_THAT(journaled_events(folder_ / "journal.sqlite"), Not(Contains(HasSubstr("bogged-down"))));
  if (transport != std::string("inproc")) {
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(mission, flown));
  }
}

class FasterTrial : public ::testing::Test {
 protected:
  ~FasterTrial() override { fs::remove_all(folder_); }

  Flight flown(const std::string& scenario, int seed = 1) {
    return fly(ROCI_SOURCE_DIR "/missions/faster", "inproc", seed,
               "--scenario " + scenario + " --run-folder " + folder_.string());
  }
  // What each rover did, in order: "scout motion w1".
  std::vector<std::string> deeds(const std::string& kind) const {
    std::vector<std::string> out;
    std::istringstream lines(text_of(folder_ / "effects.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const nlohmann::json deed = nlohmann::json::parse(line);
      if (deed["kind"] == kind)
        out.push_back(deed["robot"].get<std::string>() + " " + deed["object"].get<std::string>());
    }
    return out;
  }
  std::string trace() const {
    return run("roci-trace print " + (folder_ / "journal.sqlite").string()).output;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_faster_trial_" + std::to_string(::getpid()));
};

// R149: what was dropped is not done, and does not count as done; the next plan does it.
TEST_F(FasterTrial, WhatTheGroundDropsIsNotDoneByTheRelaunch) {
  flown("trial_relaunched");
  EXPECT_THAT(trace(), HasSubstr("plan faster 3 origin"));
  EXPECT_THAT(trace(), Not(HasSubstr("command p1.194-antenna")));
  EXPECT_THAT(deeds("downlink"), ::testing::ElementsAre("primary traverse_done"));
  EXPECT_THAT(deeds("motion").back(), "primary w9");
}

// Where no scout has been its own wheels find the trap: it backs out, and goes around within the same drive.
TEST_F(FasterTrial, APrimaryAloneFeelsTheTrapBacksOutAndGoesAround) {
  const Flight flight = flown("scout_lost_early");
  EXPECT_EQ(flight.summary["replans"], 1) << "for the scout, and none for the trap";
  EXPECT_THAT(trace(), HasSubstr("backing_out(w3)"));
  const auto motions = deeds("motion");
  EXPECT_EQ(std::ranges::count(motions, "primary w3"), 2);
  EXPECT_EQ(motions.back(), "primary w9");
}

// A circle reaches to the stand to which the scout is called, and behind the primary it cannot stand, either.
TEST_F(FasterTrial, AScoutThatFindsNoWayBackIsLeftBehind) {
  const Flight flight = flown("hidden", 86);
  EXPECT_EQ(flight.summary["goals"]["achieved"], 2);
  EXPECT_THAT(trace(), HasSubstr("scout.stand.w3 taken"));
  EXPECT_THAT(deeds("downlink"), ::testing::ElementsAre("primary traverse_done"));
}

// Its own wheels end the primary's drive, the stand before it is taken, and the scout is too near to be seen: the scout
// stands behind it.
TEST_F(FasterTrial, AScoutTooNearToBeSeenStandsBehindThePrimary) {
  const Flight flight = flown("hidden", 1023);
  EXPECT_EQ(flight.summary["goals"]["achieved"], 2);
  EXPECT_THAT(trace(), HasSubstr("primary.sight.n6 none"));
  EXPECT_THAT(trace(), HasSubstr("StandBehindPrimary"));
  EXPECT_THAT(deeds("downlink"), ::testing::ElementsAre("primary traverse_done"));
}

// What mends an error fails for good: it takes the traverse along, and the last communication goes out without it.
TEST_F(FasterTrial, AMendThatAlwaysFailsDoesNotTakeTheLastCommunicationAlong) {
  flown("marker_lost");
  EXPECT_THAT(trace(), HasSubstr("not_seen_all_the_same"));
  EXPECT_THAT(deeds("downlink"), ::testing::ElementsAre("primary no_arrival"));
}

// The scout in a hazard and the primary blocked at once; and no primary is dug in.
TEST_F(FasterTrial, APrimaryThatIsBlockedWhileTheScoutIsInAHazardGoesOn) {
  const Flight flight = flown("hidden", 193);
  EXPECT_EQ(flight.summary["goals"]["achieved"], 2);
  EXPECT_THAT(trace(), HasSubstr("blocked_all_the_same"));
  EXPECT_THAT(journaled_events(folder_ / "journal.sqlite"), Not(Contains(HasSubstr("bogged-down"))));
}

TEST_F(FasterTrial, ThePrimaryThatCannotFollowHasTheScoutBack) {
  flown("primary_blocked");
  EXPECT_THAT(trace(), HasSubstr("ComeBack from=w3 to=w2"));
}

TEST_F(FasterTrial, AScoutWithoutAWayComesBackAndTheTeamTakesAnotherRoute) {
  flown("scout_no_path");
  EXPECT_THAT(trace(), HasSubstr("ComeBack from=w3 to=w2"));
  EXPECT_THAT(trace(), HasSubstr("primary.way.w2.w3 closed"));
  EXPECT_THAT(deeds("motion"), Contains(::testing::AnyOf("primary v3", "primary u3")));
}

TEST_F(FasterTrial, NewGoalsBringTheScoutBackFirst) {
  flown("goal_change");
  EXPECT_THAT(trace(), HasSubstr("ComeBack from=w1 to=w0"));
  EXPECT_THAT(deeds("motion"), Contains("primary v3"));
}

// R131: at each stand from which several ways lead on it is open which way-point comes next until the ground says it: the
// one that was planned on first, and another one, to which the next plan goes. Each is asked for and taken once.
TEST_F(FasterTrial, WhichWayPointComesNextIsOpenUntilTheGroundSaysIt) {
  const Flight flight = flown("guided");
  EXPECT_EQ(flight.summary["goals"]["achieved"], 1);
  std::vector<std::string> asked_and_taken;
  std::istringstream lines(trace());
  for (std::string line; std::getline(lines, line);)
    if (line.find(" answered ") != std::string::npos ||
        (line.find(" decision ") != std::string::npos && line.find(".next ") != std::string::npos))
      asked_and_taken.push_back(line.substr(line.find(' ') + 1));
  EXPECT_THAT(
      asked_and_taken,
      ::testing::ElementsAre(
          ::testing::AllOf(StartsWith("decision p1."), HasSubstr("(w1) (v1) (u1)"), Not(HasSubstr("by"))),
          HasSubstr("= w1 by ground"), HasSubstr("outcome=0"),
          ::testing::AllOf(StartsWith("decision p1."), HasSubstr("(w4) (n4)"), Not(HasSubstr("by"))),
          HasSubstr("= n4 by ground"), HasSubstr("outcome=0")));
  const auto motions = deeds("motion");
  EXPECT_THAT(motions, Contains("primary n4"));
  EXPECT_THAT(motions, Not(Contains(HasSubstr("w4"))));
  EXPECT_EQ(motions.back(), "primary w9");
}

// R128, level E1: one cycle without a plan, each decision commanded by the ground.
TEST_F(FasterTrial, TheGroundCommandsTheDecisionsOfACycle) {
  const Flight flight = flown("single_decisions");
  EXPECT_EQ(flight.summary["goals"]["achieved"], 1);
  EXPECT_THAT(deeds("motion"), ::testing::ElementsAre("scout w1", "primary w1"));
  EXPECT_THAT(deeds("downlink"), ::testing::ElementsAre("primary no_arrival"));
  EXPECT_THAT(trace(), HasSubstr("scout.locomotion at(w1)"));
  EXPECT_THAT(trace(), HasSubstr("primary.locomotion at(w1)"));
}

constexpr const char* kScenarios[] = {
    "nominal",          "trial",           "trial_stopped",    "trial_relaunched",
    "fixed_times",      "marker_not_seen", "scout_no_path",    "primary_blocked",
    "scout_lost",       "no_path",         "goal_change",      "repair_overrun",
    "radio_loss",       "radio_cut",       "opportunity",      "opportunity_alone",
    "scout_lost_early", "marker_lost",     "single_decisions", "guided"};
#ifdef ROCI_ALL_TRANSPORTS
constexpr const char* kTransports[] = {"inproc", "fastdds", "cyclonedds", "mixed"};
#else
constexpr const char* kTransports[] = {"inproc"};
#endif

std::vector<Row> rows() {
  std::vector<Row> out;
  for (const char* scenario : kScenarios)
    for (const char* transport : kTransports) out.push_back({scenario, transport});
#ifndef ROCI_ALL_TRANSPORTS
  for (const char* transport : {"fastdds", "cyclonedds", "mixed"}) out.push_back({"trial", transport});
#endif
  return out;
}

INSTANTIATE_TEST_SUITE_P(Table, Faster, ::testing::ValuesIn(rows()), [](const auto& row) {
  return std::string(row.param.scenario) + "_" + row.param.transport;
});

}  // namespace
}  // namespace roci::scenario
