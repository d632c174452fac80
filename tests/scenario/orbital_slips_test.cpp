// What goes wrong with the goals of an orbital flight while it flies: slots that there are not, two modules for one slot, motions
// that the arm's planner does not find. It is named, told to who asked, and the mission goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf, ::testing::Contains, ::testing::HasSubstr, ::testing::StartsWith;

class OrbitalSlips : public ::testing::TestWithParam<const char*> {
 protected:
  OrbitalSlips() {
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/orbital", folder_ / "mission", fs::copy_options::recursive);
  }
  ~OrbitalSlips() override { fs::remove_all(folder_); }

  void with_poses(const std::string& right, const std::string& wrong) const {
    edit(folder_ / "mission/arm/poses.yaml", right, wrong);
  }

  // With these stimuli, one a line.
  Flight fly_with(const std::string& stimuli) {
    std::ofstream(folder_ / "mission/scenarios/slips.yaml")
        << "description: Goals that cannot be.\nduration_s: 20000\nstart: {battery: 600000}\nstimuli:\n"
        << stimuli;
    const Flight flight = fly((folder_ / "mission").string(), GetParam(), 1,
                              "--scenario slips --run-folder " + (folder_ / "run").string());
    events_ = journaled_events(folder_ / "run/journal.sqlite");
    return flight;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_orbital_slips_" + std::to_string(::getpid()));
  std::vector<std::string> events_;
};

TEST_P(OrbitalSlips, AnUnknownSlotAndTwoModulesInOneAreToldAndTheMissionGoesOn) {
  edit(folder_ / "mission/mission.yaml", "work: 70000", "work: 3000");
  const Flight flight = fly_with(
      "  - {at_s: 10, goal: {issuer: ground, id: spare, kind: install, importance: hard, "
      "arguments: {module: power-3, slot: s3}}}\n"
      "  - {at_s: 100, goal: {issuer: ground, id: nowhere, kind: install, importance: optional, utility: 1, "
      "arguments: {module: thermal-2, slot: s33}}}\n"
      "  - {at_s: 100, goal: {issuer: ground, id: first, kind: install, importance: hard, "
      "arguments: {module: radar-1, slot: s7}}}\n"
      "  - {at_s: 100, goal: {issuer: ground, id: second, kind: install, importance: optional, utility: 9, "
      "arguments: {module: camera-2, slot: s7}}}\n"
      "  - {at_s: 100, goal: {issuer: ground, id: timed, kind: replace, importance: optional, utility: 1, "
      "closes_s: 50, arguments: {module: camera-1}}}\n");
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), 2);
  EXPECT_EQ(flight.summary["goals"].value("dropped", -1), 1);
  EXPECT_THAT(events_, Contains(AllOf(StartsWith("goal.rejected"), HasSubstr("ground/nowhere"),
                                      HasSubstr("'s33'; the mission has no such socket, it has: s0, "),
                                      HasSubstr("did you mean 's3'?"))));
  EXPECT_THAT(events_, Contains(AllOf(StartsWith("goal.rejected"), HasSubstr("ground/timed"),
                                      HasSubstr("has passed"))));
  EXPECT_THAT(events_,
              Contains("goal.dropped goal ground/second dropped: out of reach: no plan brings it about: "
                       "a module works in a slot (module camera-2, slot s7)"));
}

// The arm's planner finds hardly a motion with the effort of one request. It is asked again, searches harder each time, and no
// goal is given up that has a plan.
TEST_P(OrbitalSlips, MotionsThatAreFoundWhenAskedForAgainLoseNoGoal) {
  with_poses("iterations: 2000", "iterations: 1");
  const Flight flight = fly_with(
      "  - {at_s: 10, goal: {issuer: ground, id: survey, kind: configure, importance: hard, "
      "arguments: {mode: survey}}}\n"
      "  - {at_s: 10, goal: {issuer: ground, id: spare, kind: install, importance: hard, "
      "arguments: {module: power-3, slot: s3}}}\n");
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), 2);
  EXPECT_THAT(events_, ::testing::Not(Contains(StartsWith("goal.failed"))));
}

// One of the slots is nowhere to be reached, and nobody can prove it. The goal for it leaves, in words that say what is not
// known and how often it was asked for; no other goal does.
TEST_P(OrbitalSlips, AMotionThatIsNeverFoundIsToldAndNoOtherGoalLeaves) {
  with_poses("iterations: 2000", "iterations: 1");
  const std::string place = "position: [1.20, -0.80, ";
  with_poses(place + "-0.02]", place + "-0.20]");  // in the module that would stand there
  const Flight flight = fly_with(
      "  - {at_s: 10, goal: {issuer: ground, id: lost, kind: install, importance: optional, utility: 9, "
      "arguments: {module: power-3, slot: s3}}}\n"
      "  - {at_s: 10, goal: {issuer: ground, id: spare, kind: install, importance: optional, utility: 1, "
      "arguments: {module: radar-1, slot: s7}}}\n");
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), 1);
  EXPECT_EQ(flight.summary["goals"].value("dropped", -1), 1);
  EXPECT_THAT(events_,
              Contains(AllOf(StartsWith("goal.dropped goal ground/lost dropped: not known: no way to "
                                        "s3 is known: arm_svc found none with the effort spent"),
                             HasSubstr("asked 5 times"))));
}

INSTANTIATE_TEST_SUITE_P(Transports, OrbitalSlips, ::testing::Values("inproc", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
