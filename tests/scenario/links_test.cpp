// The planetary mission with links between its ground, its planner, its executive and its robot, flown by the
// programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A copy of the mission with scenarios of its own.
class LinksTest : public ::testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("roci_links_mission_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", mission(), fs::copy_options::recursive);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static fs::path mission() { return folder_ / "planetary"; }

  // The nominal day, with a uplink, a planner elsewhere and a radio to the robot's body.
  static std::string with_links(const std::string& name, const std::string& settings) {
    std::ifstream in(mission() / "scenarios" / "nominal.yaml");
    std::ofstream(mission() / "scenarios" / (name + ".yaml"))
        << in.rdbuf() << "\nlinks:\n"
        << "  - {name: uplink, ends: [ground, rover]" << settings << "}\n"
        << "  - {name: engine, ends: [planner_svc, exec_svc]" << settings << "}\n"
        << "  - {name: body, ends: [sim_svc, rover]" << settings << "}\n";
    return name;
  }

  static Flight fly_scenario(const std::string& scenario, const std::string& dds) {
    return fly(mission(), dds, 1, "--scenario " + scenario);
  }

  // Of one link, as the summary tells them; each sample offered has arrived, is lost or was superseded.
  static nlohmann::json counts(int offered, int arrived, int lost, int superseded, int repeated) {
    EXPECT_EQ(offered, arrived + lost + superseded);
    return {{"offered", offered},       {"arrived", arrived}, {"lost", lost},
            {"superseded", superseded}, {"under_way", 0},     {"repeated", repeated}};
  }

  static fs::path folder_;
};

fs::path LinksTest::folder_;

TEST_F(LinksTest, WithoutLossTheTraceIsThatOfTheUnlinkedMission) {
  const Flight unlinked = fly_scenario("nominal", "inproc");
  const Flight linked = fly_scenario(with_links("clear", ", loss: 0"), "inproc");
  EXPECT_EQ(linked.exit_code, 0);
  EXPECT_EQ(linked.summary.value("trace_sha256", "none"), unlinked.summary.value("trace_sha256", ""));
  EXPECT_EQ(linked.summary["expected"].value("fault", "no report"), "");
  EXPECT_FALSE(unlinked.summary.contains("links"));
  for (const char* link : {"uplink", "engine", "body"}) {
    EXPECT_GT(linked.summary["links"][link].value("offered", 0), 0) << link;
    EXPECT_EQ(linked.summary["links"][link].value("lost", -1), 0) << link;
  }
}

TEST_P(LinksTest, AFifthIsLostAndTheMissionEndsAsStated) {
  static const Flight reference = fly_scenario(with_links("bad", ", loss: 0.2"), "inproc");
  const Flight flight = GetParam() == "inproc" ? reference : fly_scenario("bad", GetParam());
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", 0), 3);
  // A state that is lost is sent again until it arrives; lost for good are commands and calls, which their senders ask
  // about, and events. The planner's link and the ground's carry too few samples to lose one for good.
  const nlohmann::json stated{{"body", counts(1078, 1067, 10, 1, 288)},
                              {"engine", counts(6, 6, 0, 0, 0)},
                              {"uplink", counts(3, 3, 0, 0, 1)}};
  EXPECT_EQ(flight.summary["links"], stated) << "the same on each transport";
  EXPECT_EQ(flight.summary.value("trace_sha256", "none"), reference.summary.value("trace_sha256", ""));
}

INSTANTIATE_TEST_SUITE_P(Transports, LinksTest, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return test.param; });

TEST_F(LinksTest, LightTimeAndANarrowWindowedLinkDelayTheMission) {
  const Flight near = fly_scenario("nominal", "inproc");
  with_links("far", "");
  std::ofstream(mission() / "scenarios" / "far.yaml", std::ios::app)
      << "  - {name: second, ends: [arm_svc, planner_svc], light_time_s: 20, rate_bit_s: 4000}\n";
  const Flight far = fly_scenario("far", "inproc");
  EXPECT_EQ(far.exit_code, 0) << far.summary.dump();
  EXPECT_EQ(far.summary["goals"].value("achieved", 0), 3);
  EXPECT_NE(far.summary.value("trace_sha256", ""), near.summary.value("trace_sha256", ""));
}

// Within the light time of the hold the image begins that it would have kept back; the drive after it waits for the
// release, which is heard one light time late as well.
TEST_P(LinksTest, AnOrderOfTheGroundIsObeyedOneLightTimeLater) {
  const fs::path file = mission() / "scenarios" / "ordered.yaml";
  fs::copy_file(mission() / "scenarios" / "nominal.yaml", file, fs::copy_options::overwrite_existing);
  std::ofstream(file, std::ios::app)
      << "\nlinks:\n  - {name: uplink, ends: [ground, rover], light_time_s: 60}\n";
  edit(file, "duration_s: 14400", "duration_s: 1000");
  edit(file, "stimuli:\n",
       "stimuli:\n"
       "  - {at_s: 780, order: {id: wait, kind: hold}}\n"
       "  - {at_s: 880, order: {id: go-on, kind: release}}\n");
  const fs::path run_folder = folder_ / ("ordered_" + GetParam());
  fly_scenario("ordered --run-folder " + run_folder.string(), GetParam());
  std::istringstream lines(run("roci-trace print " + run_folder.string()).output);
  std::vector<std::string> done;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double time_us = 0;
    std::string kind, what, detail;
    words >> time_us >> kind >> what >> detail;
    if (kind == "command" || (kind == "ordered" && detail == "stage=3"))
      done.push_back(std::to_string(std::lround(time_us / 1e6)) + " " + what);
  }
  EXPECT_THAT(done, ElementsAre("75 p1.1-drive", "819 p1.2-take-image", "840 ground/wait", "940 p1.3-drive",
                                "940 ground/go-on"));
}

TEST_F(LinksTest, ABadLinkEndsTheRunBeforeItBegins) {
  with_links("worse", ", loss: 2");
  const Ended ended = run("roci-launch " + mission().string() + " --scenario worse --headless 2>&1");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("worse.yaml:24:"), HasSubstr("a share from 0 to 1")));
}

}  // namespace
}  // namespace roci::scenario
