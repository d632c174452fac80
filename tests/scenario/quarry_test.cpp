// Two robots, two executives, two planners with an engine that is not ours, and a driver that is not ours; no PDDL,
// no site, no arm. The mission is data and programs in a folder, flown as its owner would fly it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>

#include "planner_svc/engine_host_service.hpp"
#include "rehearsal/flight.hpp"
#include "services/process/run_summary.hpp"
#include "tests/engines/table.hpp"
#include "tests/missions/beacon/beacon_service.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path kMission = ROCI_BINARY_DIR "/tests/missions/quarry";
constexpr const char* kExecutives[] = {"exec.digger", "exec.hauler"};

std::unique_ptr<services::Service> make_planner(services::Node& node, const services::RunSettings& settings) {
  return planner::host_engines(node, settings, planner::proof::engines());
}

// The run folders of this test's flights; they are removed with it.
class QuarryFlight : public ::testing::Test {
 protected:
  ~QuarryFlight() override { fs::remove_all(folder_); }

  // By processes.
  Flight launch(const std::string& scenario, const std::string& dds, const std::string& more = "") {
    return fly(kMission, dds, 1,
               "--scenario " + scenario + " --run-folder " + new_folder().string() + " " + more);
  }

  // All services in this process.
  json rehearse(const std::string& scenario) {
    static int domain = 0;
    rehearsal::FlightOptions options;
    options.run.mission = kMission;
    options.run.scenario = scenario;
    options.run.run_folder = new_folder();
    options.domain = ++domain;
    options.programs = {{"proof_planner", make_planner}, {"beacon_driver", beacon::make_service}};
    fs::create_directories(run_folder);
    rehearsal::fly(options);
    return services::process::read_summary(run_folder, mission::load_service_list(kMission));
  }

  json file(const std::string& name) const {
    std::ifstream in(run_folder / name);
    return json::parse(in, nullptr, false);
  }

  fs::path new_folder() { return run_folder = folder_ / ("run-" + std::to_string(++flights_)); }

  fs::path run_folder;  // of the newest flight

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("roci_quarry_" + std::to_string(::getpid()));
  int flights_ = 0;
};

std::map<std::string, std::string> traces(const json& summary) {
  std::map<std::string, std::string> out;
  const json executives = summary.value("executives", json::object());
  for (const auto& [name, own] : executives.items()) out[name] = own.value("trace_sha256", "");
  return out;
}

class Quarry : public QuarryFlight,
               public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {};

TEST_P(Quarry, FliesAsItsFileExpectsWithOneTracePerExecutive) {
  const auto [scenario, dds] = GetParam();
  const Flight flight = launch(scenario, dds);
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), 2);
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  for (const char* planner : {"planner.digger", "planner.hauler"})
    EXPECT_TRUE(fs::exists(run_folder / (std::string(planner) + ".planner_calls") / "1.json")) << planner;
  static std::map<std::string, std::map<std::string, std::string>> references;  // by scenario
  const auto [reference, is_new] = references.try_emplace(scenario);
  if (is_new) reference->second = traces(rehearse(scenario));
  ASSERT_EQ(reference->second.size(), 2U);
  EXPECT_NE(reference->second.at(kExecutives[0]), reference->second.at(kExecutives[1]));
  EXPECT_EQ(traces(flight.summary), reference->second);
}

INSTANTIATE_TEST_SUITE_P(Transports, Quarry,
                         ::testing::Combine(::testing::Values("nominal", "boom_fault"),
                                            ::testing::Values("fastdds", "cyclonedds", "mixed")),
                         [](const auto& transport) {
                           return std::string(std::get<0>(transport.param)) + "_" +
                                  std::get<1>(transport.param);
                         });

TEST_F(QuarryFlight, EachExecutiveCommandsItsOwnRobotAndKeepsItsOwnFiles) {
  const json summary = rehearse("nominal");
  EXPECT_EQ(summary.value("result", ""), "achieved");
  for (const char* executive : kExecutives) {
    const std::string journal = std::string(executive) + ".journal.sqlite";
    EXPECT_TRUE(fs::exists(run_folder / journal));
    EXPECT_EQ(summary["executives"][executive].value("journal", ""), journal);
    EXPECT_EQ(summary["executives"][executive]["goals"].value("achieved", -1), 1) << executive;
    const Ended again = run("roci-replay " + (run_folder / journal).string());
    EXPECT_EQ(again.exit_code, 0) << again.output;
  }
  EXPECT_FALSE(fs::exists(run_folder / "journal.sqlite"));
  std::map<std::string, std::string> robot_of;  // by commander
  for (const json& begun : file("begun.json")) {
    const auto [known, is_new] = robot_of.try_emplace(begun.at("commander"), begun.at("robot"));
    EXPECT_EQ(known->second, begun.at("robot"));
  }
  EXPECT_EQ(robot_of,
            (std::map<std::string, std::string>{{"exec.digger", "digger"}, {"exec.hauler", "hauler"}}));
}

// exec.digger alone may have a standby (mission.yaml); both executives are killed after their second command.
TEST_F(QuarryFlight, OneOfTwoExecutivesHasAStandbyAndBothAreKilled) {
  ASSERT_EQ(::setenv("ROCI_CRASH", "after-send:2", 1), 0);
  const Flight flight = launch("nominal", "cyclonedds", "--standby");
  ::unsetenv("ROCI_CRASH");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), 2);
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  const json executives = flight.summary["executives"];
  EXPECT_GT(executives["exec.digger"].value("epoch", 0), 1)
      << "of a pair who leads again does so in a later epoch";
  EXPECT_EQ(executives["exec.hauler"].value("epoch", 0), 2);
}

// Both name the goal in the same words; one alone answers.
TEST_F(QuarryFlight, AGoalForNoRobotIsRejectedOnce) {
  const json summary = rehearse("nominal");
  EXPECT_EQ(summary["goals"].value("rejected", -1), 1);
  EXPECT_EQ(summary["executives"]["exec.digger"]["goals"].value("rejected", -1), 1)
      << "the first of the list";
}

TEST_F(QuarryFlight, WhoAsksForTheTraceOfTheRunIsToldThatThereAreTwo) {
  launch("nominal", "fastdds");
  const Ended both = run("roci-trace print " + run_folder.string() + " 2>&1");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, AllOf(HasSubstr("several executives; give one of: "),
                                 HasSubstr("exec.digger.journal.sqlite, exec.hauler.journal.sqlite")));
  const Ended one = run("roci-trace print " + (run_folder / "exec.hauler.journal.sqlite").string() +
                        " | tail -n +2 | sha256sum | cut -c1-64");
  EXPECT_THAT(one.output,
              HasSubstr(file("summary.json")["executives"]["exec.hauler"].value("trace_sha256", "none")));
}

// What both executives have heard is drawn once, in the order of its time.
TEST_F(QuarryFlight, ThePictureOfTheRunHasTheTimelinesOfBoth) {
  launch("nominal", "fastdds");
  const fs::path svg = run_folder / "run.svg";
  const Ended drawn =
      run("roci map --json --run " + run_folder.string() + " --svg " + svg.string() + " 2>&1");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
  std::ostringstream text;
  text << std::ifstream(svg).rdbuf();
  EXPECT_THAT(text.str(), AllOf(HasSubstr("digger.boom: "), HasSubstr("hauler.wheels: ")));
}

TEST_F(QuarryFlight, WhoInterruptsItIsToldThatItWasStopped) {
  const std::string folder = new_folder().string();
  const Ended ended =
      run("bash -c 'roci-launch " + kMission.string() + " --speed 1 --headless --run-folder " + folder +
          " & until [ -s " + folder + "/launch.json ]; do sleep 0.1; done; kill -TERM $!; wait $!' 2>&1");
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("stopped by a signal before the mission had ended"));
}

}  // namespace
}  // namespace roci::scenario
