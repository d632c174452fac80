// What mission and scenario files say of a lander that digs and analyzes, and of what goes wrong with it.
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
using testing::AllOf;
using testing::HasSubstr;

// The parts of the files that a test may change.
struct SamplingTexts {
  std::string arm =
      "targets: [a, b], depth_m: 0.01, collect_s: 1000, layer_noise: 0, sites: {\"0\": {}, \"1\": {hardness: "
      "1.2, joints: [1, 0, 0, 0, 0]}}";
  std::string laboratory =
      "signatures: {0_a: positive, 1_a: drawn}, microscope: {duration_s: 10, power_w: 5, heat_w: 2}";
  std::string world = "{}";
  std::string stimulus;
};

class SamplingFiles : public testing::Test {
 protected:
  RunSetup load(const SamplingTexts& files) {
    write("mission.yaml",
          "simulation:\n  robots:\n    - name: lander\n      components:\n"
          "        - {name: arm, type: sampling_arm, " +
              files.arm +
              "}\n"
              "        - {name: laboratory, type: laboratory, " +
              files.laboratory +
              "}\n"
              "        - {name: lamp, type: task, things: {bulb.left: [dark, cold]}, commands: {shine: "
              "{duration_s: 1}}}\n"
              "        - {name: antenna, type: radio}\n");
    write("scenarios/s.yaml",
          "duration_s: 50000\nworld: " + files.world + "\nstimuli:\n" +
              (files.stimulus.empty() ? "  []\n" : "  - {at_s: 1, " + files.stimulus + "}\n"));
    return load_run(folder_, "s");
  }
  std::string error_of(const SamplingTexts& files) {
    try {
      load(files);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string error_of_arm(const std::string& arm) {
    return error_of({arm, SamplingTexts{}.laboratory, "{}", ""});
  }
  std::string error_of_laboratory(const std::string& text) {
    return error_of({SamplingTexts{}.arm, text, "{}", ""});
  }
  std::string error_of_world(const std::string& world) {
    return error_of({SamplingTexts{}.arm, SamplingTexts{}.laboratory, world, ""});
  }
  std::string error_of_stimulus(const std::string& stimulus) {
    return error_of({SamplingTexts{}.arm, SamplingTexts{}.laboratory, "{}", stimulus});
  }
  // How long it takes to dig the site, or with which code that fails.
  std::string dug(const std::string& site, const std::string& world) {
    Flight run(load({SamplingTexts{}.arm, SamplingTexts{}.laboratory, world, ""}).world);
    run.command(seconds(1), execute("p", "arm", "prepare"));
    run.command(seconds(3000), execute("e", "arm", "excavate", {{"site", site}}));
    run.advance(seconds(20000));
    return run.code("e") == "done"
               ? std::to_string(std::lround(temporal::to_seconds(run.time_of("e") - seconds(3000)))) + " s"
               : run.code("e");
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_sampling_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(SamplingFiles, MakeALanderThatTellsOfAllItsThings) {
  const Flight run(load(SamplingTexts{}).world);
  EXPECT_EQ(run.state("lander.site.1"), (State{"untouched", {}}));
  EXPECT_EQ(run.state("lander.signature.0_a"), (State{"unknown", {}}));
  EXPECT_EQ(run.state("lander.bulb.left"), (State{"dark", {"cold"}}));
}

// The cutter needs 2e9 J/m³ × 0.03 m² × 0.01 m at 120 W, 5,000 s, after the way there of 170 s and 260 s.
TEST_F(SamplingFiles, AScenarioSaysHowHardTheIceIsAtOneSiteOrAtAll) {
  EXPECT_EQ(dug("0", "{duration_noise: 0}"), "5170 s");
  EXPECT_EQ(dug("1", "{duration_noise: 0}"), "6260 s");
  EXPECT_EQ(dug("0", "{duration_noise: 0, hardness: 1.5}"), "7670 s");
  EXPECT_EQ(dug("1", "{duration_noise: 0, hardness: 1.5}"), "9260 s") << "harder than all others still";
  EXPECT_EQ(dug("0", "{duration_noise: 0, sites: {\"0\": {hardness: 2}}}"), "10170 s");
  EXPECT_EQ(dug("1", "{duration_noise: 0, sites: {\"0\": {hardness: 2}}}"), "6260 s")
      << "of this nothing was said";
}

TEST_F(SamplingFiles, AScenarioSaysWhereOneCannotDigDeeper) {
  EXPECT_EQ(dug("0", "{sites: {\"0\": {deepest_m: 0.005}}}"), "too-hard");
  EXPECT_EQ(dug("1", "{duration_noise: 0, sites: {\"0\": {deepest_m: 0.005}}}"), "6260 s");
  EXPECT_EQ(dug("0", "{deepest_m: 0.005}"), "too-hard");
  EXPECT_EQ(dug("1", "{deepest_m: 0.005, sites: {\"1\": {deepest_m: 0.02}}}"), "too-hard") << "at no site";
}

TEST_F(SamplingFiles, AScenarioSaysWhatIsInTheSamples) {
  const auto found = [&](const std::string& world, const std::string& sample) {
    Flight run(load({SamplingTexts{}.arm, SamplingTexts{}.laboratory, world, ""}).world);
    const std::string site = sample.substr(0, 1);
    run.command(seconds(1), execute("p", "arm", "prepare"));
    run.command(seconds(3000), execute("e", "arm", "excavate", {{"site", site}}));
    run.command(seconds(12000), execute("c", "arm", "collect", {{"site", site}, {"target", "a"}}));
    run.command(seconds(15000), execute("t", "arm", "transport"));
    run.command(seconds(20000),
                execute("a", "laboratory", "analyze", {{"site", site}, {"target", "a"}, {"form", "raw"}}));
    run.advance(seconds(40000));
    return run.state("lander.signature." + sample).name;
  };
  EXPECT_EQ(found("{}", "0_a"), "positive");
  EXPECT_EQ(found("{signatures: negative}", "0_a"), "negative");
  EXPECT_EQ(found("{signatures: {0_a: negative}}", "0_a"), "negative");
  EXPECT_EQ(found("{signatures: positive}", "1_a"), "positive");
  EXPECT_EQ(found("{positive_share: 1}", "1_a"), "positive");
  EXPECT_EQ(found("{positive_share: 0}", "1_a"), "negative");
}

// The block of the README that begins so, without its fence.
std::string readme_block(const std::string& first) {
  std::ifstream in(std::filesystem::path(ROCI_SOURCE_DIR) / "sim_svc/README.md");
  const std::string readme(std::istreambuf_iterator<char>(in), {});
  const auto begin = readme.find(first);
  std::istringstream lines(readme.substr(begin, readme.find("```", begin) - begin));
  std::string out;
  for (std::string line; std::getline(lines, line);) out += "        " + line + "\n";
  return out;
}

TEST_F(SamplingFiles, TheReadmesArmAndLaboratoryFly) {
  write("mission.yaml",
        "simulation:\n  robots:\n    - name: lander\n      thermal: {zones: {arm: {}, vault: {}}}\n      "
        "data: {}\n"
        "      components:\n" +
            readme_block("- name: arm\n  type: sampling_arm") + readme_block("- name: laboratory"));
  write("scenarios/s.yaml", "duration_s: 1000000\nworld: {surroundings_k: 140}\n");
  Flight run(load_run(folder_, "s").world);
  run.command(seconds(1), execute("p", "arm", "prepare"));
  run.command(seconds(50000), execute("e", "arm", "excavate", {{"site", "2"}}));
  run.advance(seconds(100000));
  EXPECT_EQ(run.code("e"), "too-hard");
  EXPECT_NEAR(last_number(run.said, "lander.arm.depth_2"), 0.06, 1e-9);
  EXPECT_EQ(run.state("lander.signature.0_2"), (State{"unknown", {}}));
}

TEST_F(SamplingFiles, RefuseAnArmThatCannotBe) {
  EXPECT_THAT(error_of_arm("targets: [a]"), HasSubstr("sites"));
  EXPECT_THAT(error_of_arm("sites: {}"), HasSubstr("list one, as in sites: {\"0\": {}}"));
  EXPECT_THAT(error_of_arm("sites: {a.b: {}}"),
              AllOf(HasSubstr("yaml:5:"), HasSubstr("no name for a timeline")));
  EXPECT_THAT(error_of_arm("sites: {\"0\": {hard: 2}}"), HasSubstr("hard"));
  EXPECT_THAT(error_of_arm("sites: {\"0\": {hardness: 0}}"), HasSubstr("'hardness' must be at least"));
  EXPECT_THAT(error_of_arm("sites: {\"0\": {joints: [0, 1]}}"), HasSubstr("expected 5 joints such as"));
  EXPECT_THAT(error_of_arm("cutter_efficiency: 2, sites: {\"0\": {}}"), HasSubstr("is a share, at most 1"));
  EXPECT_THAT(error_of_arm("depth_m: 500, sites: {\"0\": {}}"), HasSubstr("at most 100 m"));
  EXPECT_THAT(error_of_arm("layer_m: 0.000001, sites: {\"0\": {}}"), HasSubstr("'layer_m' must be at least"));
  EXPECT_THAT(error_of_arm("warms: {excavate: {}}, sites: {\"0\": {}}"),
              HasSubstr("known: prepare, collect"));
  EXPECT_THAT(error_of_arm("warms: {collect: {power_w: 1}}, sites: {\"0\": {}}"), HasSubstr("power_w"));
  EXPECT_THAT(error_of_arm("warms: {collect: {heater_w: 30}}, sites: {\"0\": {}}"),
              HasSubstr("never brings it to work_k"));
  EXPECT_THAT(error_of_arm("collect_s: 60, warms: {collect: {}}, sites: {\"0\": {}}"),
              HasSubstr("warming takes 2554 s, the whole command 60 s"));
  EXPECT_THAT(error_of_world("{sites: {\"3\": {}}}"),
              AllOf(HasSubstr("s.yaml:2:"), HasSubstr("no site '3'; known: 0, 1")));
}

TEST_F(SamplingFiles, RefuseALaboratoryThatCannotBe) {
  EXPECT_THAT(error_of_laboratory("positive_share: 0.5"), HasSubstr("signatures"));
  EXPECT_THAT(
      error_of_laboratory("signatures: {0_0: postive}"),
      AllOf(HasSubstr("yaml:6:"), HasSubstr("known: negative, positive, drawn; did you mean 'positive'?")));
  EXPECT_THAT(error_of_laboratory("signatures: {0.0: drawn}"), HasSubstr("no name for a timeline"));
  EXPECT_THAT(error_of_laboratory("signatures: {0_0: drawn}, positive_share: 3"), HasSubstr("is a share"));
  EXPECT_THAT(error_of_laboratory("signatures: {0_0: drawn}, microscope: {power_w: 1, heat_w: 2}"),
              HasSubstr("no more heat than it draws"));
  EXPECT_THAT(error_of_world("{signatures: {0_b: positive}}"), HasSubstr("no sample '0_b'; known: 0_a, 1_a"));
  EXPECT_THAT(error_of_world("{signatures: yes}"), HasSubstr("unknown signature 'yes'"));
}

TEST_F(SamplingFiles, RefuseThingsThatAreNone) {
  const auto error_of_things = [&](const std::string& things) {
    SamplingTexts files;
    files.laboratory += "}\n        - {name: more, type: task, things: " + things;
    return error_of(files);
  };
  EXPECT_EQ(error_of_things("{bulb.right: dark}"), "no error");
  EXPECT_THAT(error_of_things("{bulb: dark}"), HasSubstr("'bulb' is no thing; write family.name"));
  EXPECT_THAT(error_of_things("{\"bulb.{x}\": dark}"),
              AllOf(HasSubstr("yaml:7:"), HasSubstr("no command runs at the start")));
  EXPECT_THAT(error_of_things("{bulb.x: []}"), HasSubstr("a state needs a name"));
}

TEST_F(SamplingFiles, StimuliReachTheWorld) {
  const auto what = [&](const std::string& stimulus) {
    SamplingTexts files;
    files.stimulus = stimulus;
    return std::get<world::Disturbance>(load(files).scenario.stimuli.at(0).what);
  };
  const auto collapse = std::get<world::ComponentMishap>(what("trench_collapses: {site: \"1\", share: 0.2}"));
  EXPECT_EQ(collapse.robot, "lander");
  EXPECT_EQ(std::get<world::TrenchCollapse>(collapse.what).site, "1");
  EXPECT_EQ(std::get<world::TrenchCollapse>(collapse.what).share, 0.2);
  EXPECT_TRUE(world::adds_up(collapse)) << "a world that goes on has suffered it already";
  const auto hollow = std::get<world::HollowSuccess>(what("hollow: {component: arm, command: collect}"));
  EXPECT_EQ(hollow.robot + "." + hollow.component + "." + hollow.command, "lander.arm.collect");
  EXPECT_TRUE(world::adds_up(hollow));
  EXPECT_FALSE(world::adds_up(what("fault: {component: laboratory, for_s: 10, slow: 3}")));
  EXPECT_EQ(error_of_stimulus("hollow: {component: lamp, command: shine}"), "no error");
}

TEST_F(SamplingFiles, RefuseStimuliThatBefallNothing) {
  EXPECT_THAT(error_of_stimulus("trench_collapses: {site: \"4\"}"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("no site '4'; known: 0, 1")));
  EXPECT_THAT(error_of_stimulus("trench_collapses: {site: \"1\", share: 2}"),
              HasSubstr("a share, from 0 to 1"));
  EXPECT_THAT(error_of_stimulus("hollow: {component: leg, command: collect}"),
              HasSubstr("unknown component 'leg'"));
  EXPECT_THAT(error_of_stimulus("hollow: {component: arm, command: colect}"),
              AllOf(HasSubstr("s.yaml:4:"), HasSubstr("did you mean 'collect'?")));
  EXPECT_THAT(error_of_stimulus("hollow: {component: antenna, command: send}"),
              HasSubstr("a component of type radio cannot succeed without effect"));
}

}  // namespace
}  // namespace roci::sim::scenario
