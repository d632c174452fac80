// What a lander measures and computes on board is what it foresees from then on, through real processes (R76, R101,
// R116): of that site and of no other, and beyond the planner's death.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The small lander with more to dig at its sites, where ground is harder and richer than the network says: a dig takes
// 1,200 s and not 900 s, 200 W and not 150 W, and finds a richness of 0.9 and not 0.3.
class Learning : public ::testing::TestWithParam<const char*> {
 protected:
  Learning() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/lander", mission_, fs::copy_options::recursive);
    edit(mission_ / "mission.yaml", "duration_s: 900, duration_noise: 0.1, power_w: 150,",
         "duration_s: 1200, power_w: 200, changes: {richness: {to: 0.9}},");
    edit(mission_ / "mission.yaml", "          state: rests\n",
         "          state: rests\n          numbers: {richness: 0}\n");
    edit(mission_ / "mission.yaml", "capacity_j: 600000", "capacity_j: 2000000");
    const fs::path network = mission_ / "network.yaml";
    edit(network, "value: 600000", "value: 2000000");
    edit(network, "  dig_w: {value: 150, range: [10, 1000], source: \"as in mission.yaml\"}\n",
         "  dig_w_{site}: {for: {site: sites}, value: 150, range: [10, 1000], source: chosen}\n"
         "  rich_{site}: {for: {site: sites}, value: 0.3, range: [0, 1], source: chosen}\n");
    edit(network, "{rate: -dig_w}", "{rate: \"-dig_w_{site}\"}");
    edit(network, "learns: {duration_s: \"dig_s_{site}\"}\n",
         "learns: {duration_s: \"dig_s_{site}\", power: \"dig_w_{site}\", values: {richness: "
         "\"rich_{site}\"}}\n"
         "  deepen_{site}:\n"
         "    for: {site: sites}\n"
         "    command: {owner: sim_svc, component: arm, command: dig, arguments: {site: \"{site}-deeper\"}}\n"
         "    duration_s: dig_s_{site}\n"
         "    pre: \"trench_{site} = open\"\n"
         "    impacts: {lander.battery: {rate: \"-dig_w_{site}\"}, hand: {take: 1}}\n"
         "    control: {wait_s: 3600, retries: 1}\n"
         "  report_{site}:\n"
         "    for: {site: sites}\n"
         "    command: {owner: sim_svc, component: radio, command: send, arguments: {what: "
         "\"{site}-deeper\"}}\n"
         "    duration_s: 300\n"
         "    impacts: {lander.battery: {rate: -100}}\n"
         "    control: {wait_s: 3600, retries: 2}\n"
         "    utility: {science: \"rich_{site}\"}\n"
         "    downlinks: true\n");
    edit(network, "  view:\n    batch: science\n",
         "  again_{site}:\n    for: {site: sites}\n    batch: science\n"
         "    decompositions: {whole: [\"deepen_{site}\", \"report_{site}\"]}\n"
         "  third_near:\n    batch: science\n    decompositions: {whole: [deepen_near, report_near]}\n"
         "  view:\n    batch: science\n");
    scenario("");
  }
  ~Learning() override { fs::remove_all(folder_); }

  void scenario(const std::string& expected) const {
    std::ofstream(mission_ / "scenarios/learning.yaml")
        << "description: The ground is harder and richer than thought.\nduration_s: 14400\n"
           "start: {battery: 2000000}\nstimuli:\n  - {at_s: 10, goal: {id: all, kind: mission, importance: "
           "hard}}\n"
        << "expect:\n"
        << expected << "  - goal.achieved: all\n";
  }

  static std::vector<json> of(const json& plan, const std::string& name) {
    std::vector<json> out;
    for (const json& activity : plan["activities"])
      if (activity["name"] == name) out.push_back(activity);
    return out;
  }
  static double duration_s(const json& activity) { return activity["duration_us"].get<double>() / 1e6; }
  static double power_w(const json& activity) {
    for (const json& impact : activity["impacts"])
      if (impact["timeline"] == "lander.battery" && impact["kind"] == "rate")
        return -impact["amount"].get<double>();
    return 0;
  }
  static void expect_foreseen(const json& plan, const std::string& site, double seconds, double watts,
                              double rich) {
    EXPECT_FALSE(of(plan, "deepen_" + site).empty()) << plan;
    for (const json& dig : of(plan, "deepen_" + site)) {
      EXPECT_NEAR(duration_s(dig), seconds, 1) << site;
      EXPECT_NEAR(duration_s(dig) * power_w(dig), seconds * watts, 1)
          << site << ": the energy as it was measured";
    }
    for (const json& report : of(plan, "report_" + site)) EXPECT_EQ(report["utility"], json{rich}) << site;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_learning_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "lander";
  const fs::path run_ = folder_ / "run";
};

class LearningAndDeath : public Learning {};

TEST_P(LearningAndDeath, TheNextTaskOfTheSiteIsForeseenAsMeasuredAlsoByTheNextPlanner) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 250 " ROCI_SOURCE_DIR "/tests/scenario/learning_kill.sh ${PATH%%:*} " +
                          mission_.string() + " " + GetParam() + " " + std::to_string(domain.id()) + " " +
                          run_.string() + " '\"utility\":[0.9]'");
  auto steps = steps_of(ended.output);
  for (const char* site : {"near", "far"}) expect_foreseen(steps["first"].printed, site, 900, 150, 0.3);
  expect_foreseen(steps["before"].printed, "near", 1200, 200, 0.9);
  expect_foreseen(steps["before"].printed, "far", 900, 150, 0.3);
  ASSERT_EQ(steps["killed"].exit_code, 0) << ended.output;
  EXPECT_GT(steps["after"].printed.value("version", 0), steps["before"].printed.value("version", 0));
  expect_foreseen(steps["after"].printed, "near", 1200, 200, 0.9);
  EXPECT_EQ(steps["launch"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["launch"].printed.value("result", ""), "achieved");
}

// Both sites take longer than the network thinks possible.
TEST_P(Learning, WhatIsOutOfRangeIsNamedAndTheRestOfItIsBelieved) {
  edit(mission_ / "network.yaml", "range: [60, 7200]", "range: [60, 1000]");
  scenario(
      "  - \"planner.measured\": \"the measured duration 1200\"\n"
      "  - \"planner.measured\": \"'dig_s_far' would be 1200\"\n");
  const Flight flight =
      fly(mission_.string(), GetParam(), 1, "--scenario learning --run-folder " + run_.string());
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
}

// Half a minute.
INSTANTIATE_TEST_SUITE_P(Transports, LearningAndDeath, ::testing::Values("mixed"),
                         [](const auto& dds) { return std::string(dds.param); });
INSTANTIATE_TEST_SUITE_P(Transports, Learning, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
