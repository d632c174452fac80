#include "sim_svc/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_svc/robot_file.hpp"

namespace roci::sim {
namespace {

using testing::HasSubstr;

class ScenarioFile : public testing::Test {
 protected:
  mission::Entry load(const std::string& text) {
    const auto file = folder_ / "s.yaml";
    std::ofstream(file) << text;
    return mission::Entry::load(file);
  }
  std::string error_of(const std::string& text) {
    try {
      read_scenario(load(text));
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_scenario_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  const std::string head_ = "duration_s: 100\nstart: {x: 1, y: 2, arm: stow, battery: 10}\n";
};

TEST_F(ScenarioFile, ReadsTheExpectedOrderOfEvents) {
  const Scenario s = read_scenario(
      load(head_ + "expect: [plan.adopted, goal.dropped: gap, hazard.seen+, plan.broken+: late]\n"));
  ASSERT_EQ(s.expect.size(), 4u);
  EXPECT_EQ(s.expect[0].code, "plan.adopted");
  EXPECT_EQ(s.expect[0].part, "");
  EXPECT_FALSE(s.expect[0].repeats);
  EXPECT_EQ(s.expect[1].code, "goal.dropped");
  EXPECT_EQ(s.expect[1].part, "gap");
  EXPECT_EQ(s.expect[2].code, "hazard.seen");
  EXPECT_TRUE(s.expect[2].repeats);
  EXPECT_EQ(s.expect[3].code, "plan.broken");
  EXPECT_EQ(s.expect[3].part, "late");
  EXPECT_THAT(error_of(head_ + "expect: [{a: b, c: d}]\n"), HasSubstr("s.yaml:3:10: expected one"));
  EXPECT_THAT(error_of(head_ + "expect: ['+']\n"), HasSubstr("expected an event's code"));
}

TEST_F(ScenarioFile, ReadsWhatItSays) {
  const Scenario s = read_scenario(
      load("description: d\nduration_s: 100\nstart: {x: 1, y: 2, heading: 0.5, arm: stow, battery: 10}\n"
           "world: {slip: 0.1, image_noise: 0.2, rocks: [{x: 3, y: 4, radius: 0.5}]}\n"
           "windows: [{timeline: comm.window, open: [[10, 20], [30, 40]]}]\n"
           "science: {enabled: false}\n"
           "stimuli:\n"
           "  - {at_s: 50, fault: {component: arm, for_s: 10}}\n"
           "  - {at_s: 10, goal: {id: g, kind: photo, importance: hard, utility: 2, opens_s: 5, arguments: "
           "{x: 1.5}}}\n"
           "  - {at_s: 60, recall: {id: g}}\n"
           "  - {at_s: 61, rock: {x: 1, y: 2, radius: 3}}\n"
           "  - {at_s: 62, battery_loss_j: 7}\n"));
  EXPECT_EQ(s.duration, seconds(100));
  EXPECT_EQ(s.start, (Pose{1, 2, 0.5}));
  EXPECT_EQ(s.slip, 0.1);
  ASSERT_EQ(s.rocks.size(), 1u);
  ASSERT_EQ(s.windows.size(), 1u);
  EXPECT_TRUE(s.windows[0].is_open(seconds(10)));
  EXPECT_FALSE(s.windows[0].is_open(seconds(20)));
  ASSERT_EQ(s.stimuli.size(), 5u);
  const auto& goal = std::get<GoalStimulus>(s.stimuli[0].what);
  EXPECT_EQ(goal.issuer, "ground");
  EXPECT_EQ(goal.importance, Importance::hard);
  EXPECT_EQ(goal.opens, seconds(5));
  EXPECT_EQ(goal.arguments, (std::vector<std::pair<std::string, std::string>>{{"x", "1.5"}}));
  EXPECT_EQ(std::get<ComponentFault>(std::get<Disturbance>(s.stimuli[1].what)).until, seconds(60));
  EXPECT_EQ(std::get<RecallStimulus>(s.stimuli[2].what).id, "g");
  EXPECT_EQ(std::get<EnergyLoss>(std::get<Disturbance>(s.stimuli[4].what)).joules, 7);
}

TEST_F(ScenarioFile, EveryFaultNamesItsPlaceAndARemedy) {
  struct Case {
    std::string text;
    std::string place;
    std::string says;
  };
  const std::vector<Case> cases = {
      {"duration_s: soon\n", "s.yaml:1:13", "finite number"},
      {"duration_s: -1\n", "s.yaml:1:13", "at least 0"},
      {"duration_s: 5\n", "s.yaml:1:1", "'start' is missing"},
      {head_ + "wrold: {slip: 1}\n", "s.yaml:3:1", "unknown key 'wrold'"},
      {head_ + "world: {slip: [1]}\n", "s.yaml:3:15", "finite number"},
      {head_ + "world: {rocks: [{x: 1, y: 2, radius: 0}]}\n", "s.yaml:3:38", "at least"},
      {head_ + "windows: [{timeline: w, open: [[20, 10]]}]\n", "s.yaml:3:32", "closes before it opens"},
      {head_ + "windows: [{timeline: w, open: [[1, 5], [4, 9]]}]\n", "s.yaml:3:40", "opens before"},
      {head_ + "stimuli:\n  - {at_s: 1}\n", "s.yaml:4:5", "one of goal"},
      {head_ + "stimuli:\n  - {at_s: 1, rock: {x: 1, y: 1, radius: 1}, battery_loss_j: 2}\n", "s.yaml:4:5",
       "split"},
      {head_ + "stimuli:\n  - {at_s: 101, battery_loss_j: 1}\n", "s.yaml:4:12", "after the end of the run"},
      {head_ + "stimuli:\n  - {at_s: 1, goal: {id: g}}\n", "s.yaml:4:21", "'kind' is missing"},
      {head_ + "stimuli:\n  - {at_s: 1, goal: {id: g, kind: k, importance: vital}}\n", "s.yaml:4:50",
       "hard, optional"},
      {head_ + "stimuli:\n  - {at_s: 1, recall: {id: g}}\n", "s.yaml:4:5", "no stimulus above uploads"},
      {head_ + "stimuli:\n  - {at_s: 1, fault: {component: leg, for_s: 1}}\n", "s.yaml:4:34",
       "known: nav, arm"},
  };
  for (const Case& c : cases) {
    const std::string error = error_of(c.text);
    EXPECT_THAT(error, HasSubstr(c.place)) << c.text;
    EXPECT_THAT(error, HasSubstr(c.says)) << c.text;
  }
}

TEST_F(ScenarioFile, TheSimulationSectionOverridesDefaults) {
  const RobotParameters robot = read_robot(load("drive: {slip: 0.2}\nnames: {stow_pose: folded}\n"));
  EXPECT_EQ(robot.drive.slip, 0.2);
  EXPECT_EQ(robot.names.stow_pose, "folded");
  EXPECT_EQ(robot.camera.duration_s, CameraParameters{}.duration_s);
}

TEST_F(ScenarioFile, TheSimulationSectionRefusesWhatItDoesNotKnow) {
  try {
    read_robot(load("drive: {\n  slipp: 0.2}\n"));
    FAIL();
  } catch (const mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.yaml:2:"));
    EXPECT_THAT(error.what(), HasSubstr("uphill_slip"));
  }
  EXPECT_THROW(read_robot(load("radio: {rate_bit_s: 0}\n")), mission::FileError);
}

TEST_F(ScenarioFile, TheMissionsOwnScenariosAreGood) {
  const std::filesystem::path missions = std::filesystem::path(ROCI_SOURCE_DIR) / "missions";
  int read = 0;
  for (const auto& mission : std::filesystem::directory_iterator(missions)) {
    const auto root = mission::Entry::load(mission.path() / "mission.yaml");
    if (const auto simulation = root.find("simulation")) read_robot(*simulation);
    if (!std::filesystem::exists(mission.path() / "scenarios")) continue;
    for (const auto& scenario : std::filesystem::directory_iterator(mission.path() / "scenarios")) {
      EXPECT_NO_THROW(read_scenario(mission::Entry::load(scenario.path()))) << scenario.path();
      ++read;
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace roci::sim
