// What mission and scenario files say of an arm with dynamics, a structure of slots and modules, and an orbit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_svc/scenario/run_file.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::scenario {
namespace {

using temporal::seconds;
using temporal::State;
using testing::HasSubstr;

constexpr char kUrdf[] = R"(<?xml version="1.0"?>
<robot name="crane">
  <link name="base"/>
  <link name="a"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="b"><inertial><mass value="5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="c"><inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="d"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="4" velocity="0.2" effort="200"/></joint>
  <joint name="slew" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="0.3" effort="100"/></joint>
  <joint name="luff" type="revolute"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" velocity="0.3" effort="80"/></joint>
  <joint name="turn" type="revolute"><parent link="c"/><child link="d"/><origin xyz="1 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-3" upper="3" velocity="0.5" effort="30"/></joint>
</robot>
)";

constexpr char kPoses[] =
    "tip: d\nposes:\n  home: {joints: [0, 0, 0, 0]}\n  bent: {joints: [0, 1, 1]}\n"
    "  s0: {position: [1, 1, 0]}\n  s1: {position: [1, 2, 0]}\n  s2: {position: [1, 3, 0]}\n";

// The mission's parts that a test may change.
struct Files {
  std::string slots = "{s0: {}, s1: {}, spare: {at: s2}}";
  std::string modules =
      "{m0: {slot: s0, mass_kg: 80, true_mass_kg: 95, size_m: [1, 1, 0.5]}, m1: {slot: s1, mass_kg: 40}}";
  std::string arm = "start_pose: home";
  std::string power =
      "capacity_j: 5000, idle_w: 10, orbit: {orbit_s: 600, eclipse_s: 200, first_eclipse_s: 300, solar_w: "
      "30}";
  std::string scenario = "duration_s: 2000\nstart: {battery: 4000}\n";
};

class OrbitalFiles : public testing::Test {
 protected:
  RunSetup load(const Files& files) {
    write("mission.yaml",
          "arm: {model: arm.urdf, poses: poses.yaml}\n"
          "windows: [{fact: (lit), timeline: sun.window, open: [[0, 5]]}]\n"
          "simulation:\n  robots:\n    - name: walker\n      power: {" +
              files.power +
              "}\n      components:\n"
              "        - {name: boom, type: dynamic_arm, " +
              files.arm +
              "}\n"
              "        - name: hand\n          type: grapple\n"
              "          slots: " +
              files.slots + "\n          modules: " + files.modules + "\n");
    write("scenarios/s.yaml", files.scenario);
    return load_run(folder_, "s");
  }
  std::string error_of(const Files& files) {
    try {
      load(files);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string scenario_error(const std::string& start, const std::string& stimuli) {
    Files files;
    files.scenario =
        "duration_s: 2000\nstart: {battery: 4000" + start + "}\nstimuli:\n  - {at_s: 1, " + stimuli + "}\n";
    return error_of(files);
  }
  std::string modules_error(const std::string& modules) {
    Files files;
    files.modules = modules;
    return error_of(files);
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_orbital_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
    write("arm.urdf", kUrdf);
    write("poses.yaml", kPoses);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(OrbitalFiles, MakeAWalker) {
  Flight run(load(Files{}).world);
  EXPECT_EQ(run.state("walker.boom"), (State{"idle-pose", {"home"}}));
  EXPECT_EQ(last_number(run.said, "walker.boom.q3"), 0);
  EXPECT_EQ(run.state("walker.module.m0"), (State{"latched", {"s0"}}));
  EXPECT_EQ(run.state("walker.slot.spare"), (State{"free", {}}));
  run.joints = {0, 0, 0, 0};
  run.command(seconds(1), execute("a", "boom", "move", {{"from", "home"}, {"to", "s2"}}));
  run.answer(seconds(1), "a", world::Trajectory{{{0, {0, 0, 0, 0}}, {9, {0.5, 0.3, 0.3, 0.3}}}});
  run.advance(seconds(60));
  EXPECT_EQ(run.state("walker.boom"), (State{"idle-pose", {"s2"}}));
  run.command(seconds(61), execute("b", "hand", "localize", {{"slot", "spare"}}));
  run.advance(seconds(200));
  EXPECT_EQ(run.state("walker.fix"), (State{"on", {"spare"}}));
}

TEST_F(OrbitalFiles, AScenarioChangesWhatTrulyIs) {
  Files files;
  files.scenario =
      "duration_s: 2000\nstart:\n  battery: 4000\n  hand:\n    blocked: [s1]\n    modules:\n"
      "      m1: {slot: spare, true_mass_kg: 70, health: damaged, latch_tries: 2}\n      m2: {slot: s0, "
      "mass_kg: 9}\n"
      "      m0: {slot: s1}\n";
  EXPECT_THAT(error_of(files), HasSubstr("slot 's1' cannot be blocked, 'm0' is in it"));
  files.scenario.replace(files.scenario.find("      m0"), std::string::npos, "");
  EXPECT_THAT(error_of(files), HasSubstr("'m0' is in slot 's0' already"));
  files.scenario.replace(files.scenario.find("      m2"), std::string::npos, "");
  Flight run(load(files).world);
  EXPECT_EQ(run.state("walker.module.m1"), (State{"latched", {"spare"}}));
  EXPECT_EQ(run.state("walker.health.m1"), (State{"damaged", {}}));
  EXPECT_EQ(run.state("walker.slot.s1"), (State{"free", {}}));
}

TEST_F(OrbitalFiles, TheOrbitGivesLightAndPower) {
  const RunSetup setup = load(Files{});
  ASSERT_EQ(setup.world.windows.size(), 1u);
  EXPECT_EQ(setup.world.windows[0].timeline, "sun.window");
  EXPECT_EQ(setup.world.windows[0].open[0], (std::pair(seconds(0), seconds(300))));
  EXPECT_EQ(setup.world.windows[0].open[1], (std::pair(seconds(500), seconds(900))));
  Flight run(setup.world);
  run.advance(seconds(300));
  EXPECT_EQ(last_value(run.said, "sun.window"), temporal::Value(false));
  EXPECT_EQ(last_number(run.said, "walker.battery"), 5000);  // 20 W for 300 s would be 6 kJ more
  run.advance(seconds(420));
  EXPECT_EQ(last_number(run.said, "walker.battery"), 3800);  // 10 W for 120 s
}

TEST_F(OrbitalFiles, AnEclipseStimulusDimsThePanel) {
  Files files;
  files.scenario += "stimuli: [{at_s: 0, eclipse: {generation: 0, for_s: 100}}]\n";
  const RunSetup setup = load(files);
  Flight run(setup.world);
  const auto& dim = std::get<world::Disturbance>(setup.scenario.stimuli[0].what);
  run.disturb(seconds(0), dim);
  run.advance(seconds(60));
  EXPECT_EQ(last_number(run.said, "walker.battery"), 3400);
  run.advance(seconds(120));
  EXPECT_EQ(last_number(run.said, "walker.battery"), 3400);  // 40 s without, 20 s with sun
}

TEST_F(OrbitalFiles, RefuseAStructureThatCannotBe) {
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass_kg: 1}, m1: {slot: s0, mass_kg: 1}}"),
              testing::AllOf(HasSubstr("mission.yaml:12:"), HasSubstr("'m0' is in slot 's0' already"),
                             HasSubstr("move one of them")));
  EXPECT_THAT(modules_error("{m0: {slot: S0, mass_kg: 1}}"),
              testing::AllOf(HasSubstr("mission.yaml:12:32: no slot 'S0'"), HasSubstr("did you mean 's0'?")));
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass_kg: -4}}"), HasSubstr("12:45: a mass must be above 0 kg"));
  EXPECT_THAT(modules_error("{m0: {slot: s0}}"), HasSubstr("mass_kg"));
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass_kg: 1, health: broken}}"),
              HasSubstr("known: works, damaged"));
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass_kg: 1, size_m: [1, 1]}}"),
              HasSubstr("expected three edges"));
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass_kg: 1, latch_tries: 0}}"), HasSubstr("at least 1 try"));
  EXPECT_THAT(modules_error("{m0: {slot: s0, mass: 1}}"), HasSubstr("mass"));
  Files files;
  files.slots = "{s0: {}, s1: {}, s7: {}}";
  EXPECT_THAT(error_of(files), testing::AllOf(HasSubstr("mission.yaml:11:"),
                                              HasSubstr("slot 's7' has no pose"), HasSubstr("poses.yaml")));
}

TEST_F(OrbitalFiles, RefuseAnArmThatDoesNotFit) {
  Files files;
  files.arm = "start_pose: bent";
  EXPECT_THAT(error_of(files), HasSubstr("pose 'bent' has 3 joints, the arm has 4"));
  files.arm = "start_pose: home, degrading_joint: lugf, friction_growth: 0.1";
  EXPECT_THAT(error_of(files), HasSubstr("known: rail, slew, luff, turn; did you mean 'luff'?"));
  files.arm = "start_pose: home, friction_growth: 0.1";
  EXPECT_THAT(error_of(files), HasSubstr("add degrading_joint"));
  files.arm = "start_pose: home, gear_efficiency: 1.5";
  EXPECT_THAT(error_of(files), HasSubstr("'gear_efficiency' must be at most 1"));
  files.arm = "start_pose: home, gravity: [0, 1]";
  EXPECT_THAT(error_of(files), HasSubstr("expected three numbers"));
  files.arm = "start_pose: home, model: gone.urdf";
  EXPECT_THAT(error_of(files), HasSubstr("gone.urdf cannot be read"));
}

TEST_F(OrbitalFiles, RefuseStimuliThatBefallNothing) {
  EXPECT_THAT(scenario_error("", "module_fails: {module: m3}"),
              testing::AllOf(HasSubstr("s.yaml:4:29: no module 'm3'"), HasSubstr("did you mean 'm0'?")));
  EXPECT_THAT(scenario_error("", "slot_blocked: {slot: spar}"), HasSubstr("did you mean 'spare'?"));
  EXPECT_THAT(scenario_error("", "slow_joint: {joint: slwe, friction: 0.5}"),
              HasSubstr("did you mean 'slew'?"));
  EXPECT_THAT(scenario_error("", "slow_joint: {joint: slew}"), HasSubstr("add friction or growth"));
  EXPECT_THAT(scenario_error("", "eclipse: {generation: 1.5, for_s: 9}"), HasSubstr("a share, from 0 to 1"));
  EXPECT_THAT(scenario_error("", "module_fails: {module: m1}"), "no error");
  EXPECT_THAT(scenario_error(", hand: {blocked: [s5]}", "module_fails: {module: m1}"),
              HasSubstr("no slot 's5'"));
}

TEST_F(OrbitalFiles, RefuseAnOrbitThatCannotBe) {
  Files files;
  files.power = "capacity_j: 5, orbit: {orbit_s: 600, eclipse_s: 600}";
  EXPECT_THAT(error_of(files), HasSubstr("the eclipse would last as long as the orbit"));
  files.power = "capacity_j: 5, solar_peak_w: 3, orbit: {orbit_s: 600}";
  EXPECT_THAT(error_of(files), HasSubstr("has no day of a planet"));
  files = Files{};
  files.scenario += "windows: [{timeline: sun.window, open: [[0, 9]]}]\n";
  EXPECT_THAT(error_of(files), HasSubstr("'sun.window' follows from the orbit of 'walker'"));
}

}  // namespace
}  // namespace roci::sim::scenario
