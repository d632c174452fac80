#include "sim_svc/scenario/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_svc/scenario/run_file.hpp"

namespace roci::sim::scenario {

using temporal::seconds;

namespace {

using testing::HasSubstr;

constexpr char kRover[] =
    "site: site.yaml\narm: {poses: poses.yaml}\nsimulation:\n  robots:\n    - name: rover\n      "
    "components:\n"
    "        - {name: nav, type: drive}\n        - {name: arm, type: arm}\n"
    "        - {name: camera, type: camera}\n      power: {capacity_j: 100}\n";

class ScenarioFile : public testing::Test {
 protected:
  // A run of the mission under the scenario with this text.
  RunSetup load(const std::string& scenario, const std::string& mission = kRover) {
    write("scenarios/s.yaml", scenario);
    write("mission.yaml", mission);
    return load_run(folder_, "s");
  }
  std::string error_of(const std::string& scenario, const std::string& mission = kRover) {
    try {
      load(scenario, mission);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_scenario_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
    write("poses.yaml", "poses:\n  stow: {joints: [0, 1]}\n");
    write("site.yaml",
          "image: rocks.pgm\nresolution: 100\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
          "free_thresh: 0.2\n");
    write("rocks.pgm", "P2\n2 2\n255\n255 255\n255 255\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  const std::string head_ = "duration_s: 100\nstart: {x: 1, y: 2, arm: stow, battery: 10}\n";
};

TEST_F(ScenarioFile, TheSurfaceOfTheScenarioStandsOverThatOfTheMission) {
  std::string mission = kRover;
  mission.replace(mission.find("  robots:"), 0,
                  "  surface: {odd_per_hectare: 7, sun: {elevation_deg: 50}}\n");
  const RunSetup run =
      load(head_ + "world: {surface: {odd_per_hectare: 3}, panorama_every_s: 60}\n", mission);
  EXPECT_EQ(run.world.ground.surface.odd_per_hectare, 3);
  EXPECT_EQ(run.world.ground.surface.sun.elevation_deg, 50);
  EXPECT_THAT(error_of(head_ + "world: {panorama_every_s: 0.5}\n"),
              HasSubstr("must be at least 1, or 0 for none"));
  EXPECT_THAT(error_of(head_ + "world: {width_px: 4}\n"), HasSubstr("must lie between"));
}

TEST_F(ScenarioFile, AStimulusSetsAValueAsTheGroundDoes) {
  const Scenario s =
      load(head_ +
           "stimuli:\n"
           "  - {at_s: 1, set: {id: a, timeline: rover.go, value: true}}\n"
           "  - {at_s: 2, set: {id: b, timeline: rover.share, value: -0.5, issuer: me, robot: rover}}\n"
           "  - {at_s: 3, set: {id: c, timeline: hold, value: clear}}\n"
           "  - {at_s: 4, set: {id: d, timeline: hold, value: 5mm}}\n"
           "  - {at_s: 5, set: {id: e, timeline: hold, value: inf}}\n")
          .scenario;
  const auto set = [&](std::size_t i) { return std::get<OrderStimulus>(s.stimuli.at(i).what); };
  EXPECT_EQ(set(0).issuer, "ground");
  EXPECT_EQ(set(0).id, "a");
  EXPECT_EQ(set(0).target, "rover.go");
  EXPECT_EQ(set(0).value, temporal::Value(true));
  EXPECT_EQ(set(1).issuer, "me");
  EXPECT_EQ(set(1).robot, "rover");
  EXPECT_EQ(set(1).value, temporal::Value(-0.5));
  EXPECT_EQ(set(2).value, temporal::Value(temporal::state("clear")));
  EXPECT_EQ(set(3).value, temporal::Value(temporal::state("5mm"))) << "a name, as all of it is no number";
  EXPECT_EQ(set(4).value, temporal::Value(temporal::state("inf"))) << "no timeline is infinite";
  EXPECT_THAT(error_of(head_ + "stimuli:\n  - {at_s: 1, set: {id: a, value: true}}\n"),
              HasSubstr("'timeline' is missing"));
  EXPECT_THAT(error_of(head_ + "stimuli:\n  - {at_s: 1, set: {id: a, timeline: t, to: true}}\n"),
              HasSubstr("'to'"));
}

TEST_F(ScenarioFile, AStimulusIsAnyOrderOfTheGround) {
  const Scenario s = load(head_ +
                          "stimuli:\n"
                          "  - {at_s: 1, order: {id: a, kind: safe}}\n"
                          "  - {at_s: 2, order: {id: b, kind: drop, activity: p1.2-drive, issuer: me}}\n"
                          "  - {at_s: 3, order: {id: c, kind: relaunch, robot: rover}}\n"
                          "  - {at_s: 4, order: {id: d, kind: autonomy, level: E2}}\n"
                          "  - {at_s: 5, order: {id: e, kind: answer, decision: way, choice: left}}\n"
                          "  - {at_s: 6, order: {id: f, kind: answer, decision: way, value: wp3}}\n"
                          "  - {at_s: 7, order: {id: g, kind: hold}}\n"
                          "  - {at_s: 8, order: {id: h, kind: command, component: wheels, command: go, "
                          "arguments: {to: w1, slow: true}}}\n")
                         .scenario;
  const auto order = [&](std::size_t i) { return std::get<OrderStimulus>(s.stimuli.at(i).what); };
  EXPECT_EQ(order(0).kind, OrderKind::safe);
  EXPECT_EQ(order(1).kind, OrderKind::drop);
  EXPECT_EQ(order(1).target, "p1.2-drive");
  EXPECT_EQ(order(1).issuer, "me");
  EXPECT_EQ(order(2).robot, "rover");
  EXPECT_EQ(order(3).level, 2);
  EXPECT_EQ(order(4).target, "way");
  EXPECT_EQ(order(4).choice, "left");
  EXPECT_EQ(order(5).value, temporal::Value(temporal::state("wp3")));
  EXPECT_EQ(order(6).target, "") << "everything";
  EXPECT_EQ(order(7).target, "wheels");
  EXPECT_EQ(order(7).value, temporal::Value(temporal::state("go", {"to=w1", "slow=true"})));
  const auto fault = [&](const std::string& text) {
    return error_of(head_ + "stimuli:\n  - {at_s: 1, order: {id: a, " + text + "}}\n");
  };
  EXPECT_THAT(fault("kind: dance"), HasSubstr("unknown order 'dance'; known: hold"));
  EXPECT_THAT(fault("kind: drop"), HasSubstr("'activity' is missing"));
  EXPECT_THAT(fault("kind: safe, activity: b"), HasSubstr("'activity'"));
  EXPECT_THAT(fault("kind: autonomy, level: E7"), HasSubstr("one of: E1, E2, E3, E4"));
  EXPECT_THAT(fault("kind: command, component: wheels"), HasSubstr("'command' is missing"));
  EXPECT_THAT(fault("kind: answer, decision: way, choice: a, value: b"), HasSubstr("keep one"));
}

TEST_F(ScenarioFile, ReadsTheExpectedOrderOfEvents) {
  const Scenario s =
      load(head_ + "expect: [plan.adopted, goal.dropped: gap, hazard.seen+, plan.broken+: late]\n").scenario;
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
  const RunSetup run = load(
      "description: d\nduration_s: 100\nstart: {x: 1, y: 2, heading: 0.5, arm: stow, battery: 10}\n"
      "world: {slip: 0.1, image_noise: 0.2, rocks: [{x: 3, y: 4, radius: 0.5}]}\n"
      "windows: [{timeline: comm.window, open: [[10, 20], [30, 40]]}]\n"
      "science: {enabled: false}\n"
      "stimuli:\n"
      "  - {at_s: 50, fault: {component: arm, for_s: 10}}\n"
      "  - {at_s: 10, goal: {id: g, kind: photo, importance: hard, utility: 2, opens_s: 5, arguments: "
      "{x: 1.5}}}\n"
      "  - {at_s: 60, recall: {id: g}}\n"
      "  - {at_s: 61, rock: {x: 1, y: 2, radius: 3}}\n"
      "  - {at_s: 62, battery_loss_j: 7}\n");
  const Scenario& s = run.scenario;
  EXPECT_EQ(s.duration, seconds(100));
  EXPECT_EQ(s.starts.at("rover").pose, (world::Pose{1, 2, 0.5}));
  EXPECT_EQ(s.starts.at("rover").battery_j, 10);
  EXPECT_EQ(s.conditions.at("slip").number(), 0.1);
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
  const auto& fault = std::get<world::ComponentFault>(std::get<world::Disturbance>(s.stimuli[1].what));
  EXPECT_EQ(fault.until, seconds(60));
  EXPECT_EQ(fault.robot, "rover");
  EXPECT_EQ(std::get<RecallStimulus>(s.stimuli[2].what).id, "g");
  EXPECT_EQ(std::get<world::EnergyLoss>(std::get<world::Disturbance>(s.stimuli[4].what)).joules, 7);
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

TEST_F(ScenarioFile, TheMissionsOwnScenariosAreGood) {
  const std::filesystem::path missions = std::filesystem::path(ROCI_SOURCE_DIR) / "missions";
  int read = 0;
  for (const auto& mission : std::filesystem::directory_iterator(missions)) {
    if (!std::filesystem::exists(mission.path() / "scenarios")) continue;
    for (const auto& scenario : std::filesystem::directory_iterator(mission.path() / "scenarios")) {
      EXPECT_NO_THROW(load_run(mission.path(), scenario.path().stem())) << scenario.path();
      ++read;
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace roci::sim::scenario
