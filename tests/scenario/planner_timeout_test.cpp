// A planner that has not found a plan when its time on the wall is over, in flight on the live clock. The mission says
// how long that is (60 s on a robot); here it is over at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

class PlannerTimeout : public ::testing::TestWithParam<const char*> {
 protected:
  PlannerTimeout() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder / "mission", fs::copy_options::recursive);
    edit(folder / "mission/mission.yaml", "wall_s: 60}", "wall_s: 0.000001}");
    std::ofstream(folder / "mission/scenarios/one.yaml")
        << "description: Two photos.\nduration_s: 3600\nstart: {x: 40, y: 40, heading: 0, arm: stow, "
           "battery: 900000}\n"
           "science: {enabled: false}\nstimuli:\n"
           "  - {at_s: 5, goal: {issuer: ground, id: near, kind: photo, importance: hard, arguments: {x: 46, "
           "y: 42}}}\n"
           "  - {at_s: 5, goal: {issuer: ground, id: nice, kind: photo, importance: optional, utility: 1, "
           "arguments: {x: 44, y: 44}}}\n";
  }
  ~PlannerTimeout() override { fs::remove_all(folder); }

  std::vector<std::string> events() const { return journaled_events(folder / "run/journal.sqlite"); }

  const fs::path folder = fs::temp_directory_path() / ("roci_planner_timeout_" + std::to_string(::getpid()));
};

// The least of the goals goes first, then the hard one fails; the mission ends by itself, with the reason, and long
// before its time is up.
TEST_P(PlannerTimeout, InFlightCostsGoalsWithTheirReasonAndNothingElse) {
  const Ended ended =
      run("timeout 100 roci-launch " + (folder / "mission").string() + " --scenario one --dds " + GetParam() +
          " --clock live --speed 20 --headless --json --run-folder " + (folder / "run").string());
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "partial") << ended.output;
  EXPECT_EQ(summary["goals"].value("open", -1), 0) << ended.output;
  EXPECT_LT(summary.value("sim_s", 1e9), 1800) << ended.output;
  EXPECT_THAT(events(), Contains(AllOf(HasSubstr("goal.dropped"), HasSubstr("nice"), HasSubstr("time"))));
  EXPECT_THAT(events(), Contains(AllOf(HasSubstr("goal.failed"), HasSubstr("near"), HasSubstr("time"))));
}

INSTANTIATE_TEST_SUITE_P(Transports, PlannerTimeout, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
