#include "sim_svc/setup/roster_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/run_file.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::setup {
namespace {

using testing::HasSubstr;

// A mission without site, arm and PDDL.
class RosterFile : public testing::Test {
 protected:
  scenario::RunSetup load(const std::string& robots, const std::string& scenario = "duration_s: 9\n",
                          const Registry& types = components::standard_types()) {
    std::ofstream(folder_ / "mission.yaml") << "simulation:\n  robots:\n" << robots;
    std::ofstream(folder_ / "scenarios/nominal.yaml") << scenario;
    return scenario::load_run(folder_, "nominal", types);
  }
  std::string error_of(const std::string& robots, const std::string& scenario = "duration_s: 9\n") {
    try {
      load(robots, scenario);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_roster_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(RosterFile, ARobotOfTasksNeedsNoSiteNoArmAndNoStart) {
  const auto run = load(
      "    - {name: station, components: [{name: door, type: task, commands: {open: {duration_s: 3}}}]}\n");
  ASSERT_EQ(run.world.robots.size(), 1u);
  EXPECT_EQ(run.world.robots[0].name, "station");
  EXPECT_FALSE(run.world.robots[0].pose);
  EXPECT_FALSE(run.world.robots[0].power);
  EXPECT_EQ(run.world.ground.site, nullptr);
}

// The README's example of a component that is data alone.
TEST_F(RosterFile, TheReadmesTaskFlies) {
  std::ifstream in(std::filesystem::path(ROCI_SOURCE_DIR) / "sim_svc/README.md");
  const std::string readme(std::istreambuf_iterator<char>(in), {});
  const auto begin = readme.find("- name: drill");
  std::istringstream lines(readme.substr(begin, readme.find("```", begin) - begin));
  std::string robot =
      "    - name: rover\n      components:\n        - {name: nav, type: task, state: [idle-at, a]}\n";
  for (std::string line; std::getline(lines, line);) robot += "        " + line + "\n";
  Flight run(load(robot).world);
  EXPECT_EQ(run.state("rover.drill"), (temporal::State{"up", {}}));
  EXPECT_EQ(last_number(run.said, "rover.drill.bits"), 4);
  run.command(temporal::seconds(1), execute("b", "drill", "bore", {{"hole", "h1"}}));
  EXPECT_EQ(run.state("rover.drill"), (temporal::State{"boring", {"h1"}}));
  run.advance(temporal::seconds(200));
  EXPECT_EQ(run.state("rover.drill"), (temporal::State{"in", {"h1"}}));
  EXPECT_EQ(last_number(run.said, "rover.drill.depth"), 20);
  EXPECT_EQ(last_number(run.said, "rover.drill.bits"), 3);
  run.command(temporal::seconds(201), execute("c", "drill", "bore", {{"hole", "h2"}}));
  run.command(temporal::seconds(210), execute("s", "drill", "stop"));
  EXPECT_EQ(run.state("rover.drill"), (temporal::State{"jammed", {}}));
}

TEST_F(RosterFile, SettingsOfTheScenarioComeBeforeTheMissions) {
  std::map<std::string, double> read;
  Registry types;
  types.add("probe", {[&](Settings& in) {
              read["gain"] = in.number("gain", 1);
              read["range"] = in.number("range", 2);
              read["bias"] = in.number("bias", 3);
              return [](world::RandomStream) { return std::unique_ptr<world::Component>(); };
            }});
  load("    - {name: a, components: [{name: p, type: probe, gain: 10, range: 20}]}\n",
       "duration_s: 9\nworld: {gain: 100}\n", types);
  EXPECT_EQ(read, (std::map<std::string, double>{{"gain", 100}, {"range", 20}, {"bias", 3}}));
}

TEST_F(RosterFile, TwoRobotsHaveStartsOfTheirOwn) {
  const std::string robots =
      "    - {name: a, power: {capacity_j: 50}, components: []}\n"
      "    - {name: b, power: {}, components: []}\n"
      "    - {name: c, components: []}\n";
  const auto run = load(robots, "duration_s: 9\nstart: {a: {battery: 5}, b: {x: 1, y: 2, battery: 6}}\n");
  EXPECT_EQ(run.world.robots[0].power->start_j, 5);
  EXPECT_EQ(run.world.robots[0].power->parameters.capacity_j, 50);
  EXPECT_EQ(run.world.robots[1].power->start_j, 6);
  EXPECT_EQ(run.world.robots[1].pose, (world::Pose{1, 2, 0}));
  EXPECT_FALSE(run.world.robots[2].pose);
  EXPECT_THAT(error_of(robots, "duration_s: 9\nstart: {a: {battery: 5}}\n"), HasSubstr("'b' is missing"));
  EXPECT_THAT(error_of(robots, "duration_s: 9\nstart: {battery: 5}\n"), HasSubstr("known here: a, b, c"));
}

TEST_F(RosterFile, AStimulusSaysWhichRobotItConcerns) {
  const std::string robots =
      "    - {name: a, power: {}, components: [{name: t, type: task}]}\n"
      "    - {name: b, components: [{name: u, type: task}]}\n";
  const std::string head = "duration_s: 9\nstart: {a: {battery: 5}}\nstimuli:\n";
  const auto run = load(robots, head + "  - {at_s: 1, robot: b, fault: {component: u, for_s: 2}}\n");
  const auto& fault =
      std::get<world::ComponentFault>(std::get<world::Disturbance>(run.scenario.stimuli.at(0).what));
  EXPECT_EQ(fault.robot, "b");
  EXPECT_THAT(error_of(robots, head + "  - {at_s: 1, battery_loss_j: 1}\n"),
              HasSubstr("say which with robot"));
  EXPECT_THAT(error_of(robots, head + "  - {at_s: 1, robot: x, battery_loss_j: 1}\n"),
              HasSubstr("known: a, b"));
  EXPECT_THAT(error_of(robots, head + "  - {at_s: 1, robot: b, battery_loss_j: 1}\n"),
              HasSubstr("no battery"));
  EXPECT_THAT(error_of(robots, head + "  - {at_s: 1, robot: a, fault: {component: u, for_s: 2}}\n"),
              HasSubstr("unknown component 'u'; known: t"));
}

TEST_F(RosterFile, EveryFaultNamesItsPlaceAndARemedy) {
  struct Case {
    std::string robots;
    std::string place;
    std::string says;
  };
  const std::string task = "    - {name: a, components: [{name: t, type: task, ";
  const std::vector<Case> cases = {
      {"    []\n", "yaml:3:5", "a world needs a robot"},
      {"    - {components: []}\n", "yaml:3:7", "'name' is missing"},
      {"    - {name: a.b, components: []}\n", "yaml:3:14", "no name for a timeline"},
      {"    - {name: a, wings: 2, components: []}\n", "yaml:3:17", "unknown key 'wings'"},
      {"    - {name: a, components: [{name: n, type: wing}]}\n", "yaml:3:46",
       "no component type 'wing'; known: arm, camera, d"},
      {"    - {name: a, components: [{name: x, type: task}]}\n", "yaml:3:37", "'x' is taken"},
      {"    - {name: a, components: [{name: n, type: task}, {name: n, type: task}]}\n", "yaml:3:53",
       "stands above already"},
      {"    - {name: a, components: []}\n    - {name: a, components: []}\n", "yaml:4:7",
       "stands above already"},
      {"    - {name: a, power: {capacity_j: 0}, components: []}\n", "yaml:3:37", "at least"},
      {"    - {name: a, components: [{name: r, type: radio, rate: 3}]}\n", "yaml:3:59", "rate_bit_s"},
      {"    - {name: a, components: [{name: r, type: radio, rate_bit_s: 0}]}\n", "yaml:3:65", "at least"},
      {"    - {name: a, components: [{name: n, type: drive}]}\n", "nominal.yaml:1:1", "'start' is missing"},
      {task + "commands: {go: {}}}]}\n", "yaml:3:67", "'duration_s' is missing"},
      {task + "commands: {stop: {duration_s: 1}}}]}\n", "yaml:3:69", "every component has the command stop"},
      {task + "commands: {go: {duration_s: 1, then: [at, \"{to}\"]}}}]}\n", "yaml:3:89",
       "no argument of 'go'"},
      {task + "commands: {go: {duration_s: 1, changes: {depth: {by: 1}}}}}]}\n", "yaml:3:100",
       "none of this component's numbers"},
      {task + "numbers: {d: 0}, commands: {go: {duration_s: 1, changes: {d: {by: 1, to: 2}}}}}]}\n",
       "yaml:3:113", "either by or to"},
      {task + "numbers: {d: {resolution: 10}}}]}\n", "yaml:3:78", "at most 1"},
      {task + "commands: {go: {duration_s: 1, gains_within_s: 1}}}]}\n", "yaml:3:99",
       "write gains_j beside it"},
      {task + "commands: {go: {duration_s: 1, failed: x}}}]}\n", "yaml:3:91", "write gains_j beside it"},
      {task + "commands: {go: {duration_s: 1, gains_j: 1, gains_within_s: 2}}}]}\n", "yaml:3:111",
       "longer than duration_s"},
  };
  for (const Case& c : cases) {
    const std::string error = error_of(c.robots);
    EXPECT_THAT(error, HasSubstr(c.place)) << c.robots;
    EXPECT_THAT(error, HasSubstr(c.says)) << c.robots;
  }
}

TEST_F(RosterFile, AStartOrAConditionThatNobodyWantsIsRefused) {
  const std::string radio = "    - {name: a, components: [{name: r, type: radio}]}\n";
  EXPECT_THAT(error_of(radio, "duration_s: 9\nstart: {r: on}\n"), HasSubstr("no choice of how it starts"));
  EXPECT_THAT(error_of(radio, "duration_s: 9\nstart: {battery: 3}\n"), HasSubstr("has no battery"));
  EXPECT_THAT(error_of(radio, "duration_s: 9\nworld: {slip: 3}\n"), HasSubstr("unknown key 'slip'"));
  EXPECT_EQ(error_of(radio, "duration_s: 9\nworld: {rate_noise: 0}\n"), "no error");
}

}  // namespace
}  // namespace roci::sim::setup
