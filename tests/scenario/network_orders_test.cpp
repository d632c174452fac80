// Task networks and parameters from the ground, through real processes: taken whole or not at all, one light time after
// they were sent, and kept beyond the planner's death (R83, R116, R118).
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
using ::testing::Contains, ::testing::Not;

// The small lander, whose ground may do everything; it digs the far site 1,200 s after the start.
class NetworkOrders : public ::testing::TestWithParam<const char*> {
 protected:
  NetworkOrders() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/lander", mission_, fs::copy_options::recursive);
    std::ofstream(mission_ / "mission.yaml", std::ios::app) << "ground: {uploads: [network, parameters]}\n";
    pack("near.htn", "version: 1\n", "version: 2\n", "sets: {sites: [near, far]}", "sets: {sites: [near]}");
  }
  ~NetworkOrders() override { fs::remove_all(folder_); }

  // The flight ends with the farewell, which waits for its window.
  void end_sooner() const {
    edit(mission_ / "network.yaml", "window_s: [7200, none]", "window_s: [3000, none]");
  }

  // Packs the mission's network with two changes.
  void pack(const std::string& name, const std::string& right, const std::string& wrong,
            const std::string& right_2 = "", const std::string& wrong_2 = "") const {
    const fs::path yaml = mission_ / "changed.yaml";
    fs::copy_file(mission_ / "network.yaml", yaml, fs::copy_options::overwrite_existing);
    edit(yaml, right, wrong);
    if (!right_2.empty()) edit(yaml, right_2, wrong_2);
    ASSERT_EQ(run("roci-network pack " + yaml.string() + " -o " + (mission_ / name).string()).exit_code, 0);
  }
  void damage(const std::string& name, const std::string& from, std::size_t byte, std::size_t size) const {
    std::string text = text_of(mission_ / from);
    text.resize(std::min(size, text.size()));
    if (byte < text.size()) text[byte] = static_cast<char>(text[byte] ^ 0x10);
    std::ofstream(mission_ / name, std::ios::binary) << text;
  }
  void scenario(const std::string& stimuli, const std::string& expected, const std::string& more = "") const {
    std::ofstream(mission_ / "scenarios/ground.yaml")
        << "description: The ground changes the network.\nduration_s: 14400\nstart: {battery: 600000}\n"
        << more << "stimuli:\n  - {at_s: 10, goal: {id: all, kind: mission, importance: hard}}\n"
        << stimuli << "expect:\n"
        << expected << "  - goal.achieved: all\n";
  }
  Flight launch() const {
    return fly(mission_.string(), GetParam(), 1, "--scenario ground --run-folder " + run_.string());
  }
  std::vector<std::string> deeds() const { return deeds_of(run_); }
  static std::string fault(const Flight& flight) {
    return flight.summary["expected"].value("fault", "no report");
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_network_orders_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "lander";
  const fs::path run_ = folder_ / "run";
};

TEST_P(NetworkOrders, ANewNetworkIsInForceFromThenOn) {
  scenario(
      "  - {at_s: 600, network: {id: n2, file: ../near.htn}}\n",
      "  - network.accepted: the network of ground/n2\n  - network.in_force: the network of ground/n2\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
  EXPECT_THAT(deeds(), Contains("send near")) << "what had begun goes on";
  EXPECT_THAT(deeds(), Not(Contains("dig far")));
  EXPECT_THAT(deeds(), Contains("farewell "));
}

TEST_P(NetworkOrders, WhatIsWrongIsRefusedWholeAndTheOneInForceGoesOn) {
  damage("flipped.htn", "near.htn", 400, std::string::npos);
  damage("cut.htn", "near.htn", std::string::npos, 300);
  pack("stale.htn", "version: 1\n", "version: 1\n");
  std::ofstream(mission_ / "huge.htn", std::ios::binary) << std::string((8U << 20U) + 1, 'x');
  scenario(
      "  - {at_s: 600, network: {id: flipped, file: ../flipped.htn}}\n"
      "  - {at_s: 610, network: {id: cut, file: ../cut.htn}}\n"
      "  - {at_s: 620, network: {id: stale, file: ../stale.htn}}\n"
      "  - {at_s: 630, network: {id: huge, file: ../huge.htn}}\n"
      "  - {at_s: 1700, network: {id: late, file: ../near.htn}}\n"
      "  - {at_s: 1710, parameter: {id: range, name: dig_s_far, value: 9000}}\n",
      "  - network.refused: at byte\n  - network.refused: at byte\n  - network.refused: is not newer than "
      "version 1\n"
      "  - network.refused: make the network smaller\n  - network.refused: has begun and is not in the "
      "network\n"
      "  - network.refused: the value before stays\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
  EXPECT_THAT(deeds(), Contains("send far"));
}

TEST_P(NetworkOrders, AParameterIsInForceAndWhatHasNotBegunIsPlacedAnew) {
  scenario("  - {at_s: 600, parameter: {id: far, name: dig_s_far, value: 1000}}\n",
           "  - network.accepted: ground/far\n  - network.in_force: ground/far\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
  EXPECT_THAT(deeds(), Contains("send far"));
}

// Then no version of the plan is made any more that could tell of them.
TEST_P(NetworkOrders, WhatComesWhenEverythingIsExecutedIsInForceAtOnce) {
  end_sooner();
  pack("near.htn", "version: 1\n", "version: 2\n", "sets: {sites: [near, far]}", "sets: {sites: [near]}");
  scenario(
      "  - {at_s: 9000, network: {id: n2, file: ../near.htn}}\n"
      "  - {at_s: 9100, parameter: {id: near, name: dig_s_near, value: 900}}\n",
      "  - goal.achieved: all\n  - network.accepted: ground/n2\n"
      "  - \"network.in_force\": \"there is nothing to plan now\"\n"
      "  - network.accepted: ground/near\n"
      "  - \"network.in_force\": \"there is nothing to plan now\"\n");
  edit(mission_ / "scenarios/ground.yaml", "there is nothing to plan now\"\n  - goal.achieved: all\n",
       "there is nothing to plan now\"\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
}

TEST_P(NetworkOrders, WhatIsGivenTwiceIsTakenOnce) {
  scenario(
      "  - {at_s: 600, network: {id: n2, file: ../near.htn}}\n"
      "  - {at_s: 900, network: {id: n2, file: ../near.htn}}\n",
      "  - network.accepted: the network of ground/n2\n  - network.in_force: the network of ground/n2\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
}

TEST_P(NetworkOrders, WithoutTheMissionsLeaveNothingIsTaken) {
  edit(mission_ / "mission.yaml", "uploads: [network, parameters]", "uploads: []");
  scenario(
      "  - {at_s: 600, network: {id: n2, file: ../near.htn}}\n"
      "  - {at_s: 610, parameter: {id: p, name: dig_s_far, value: 1200}}\n",
      "  - \"network.refused\": \"write 'ground: {uploads: [network]}'\"\n"
      "  - \"network.refused\": \"write 'ground: {uploads: [parameters]}'\"\n");
  const Flight flight = launch();
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(fault(flight), "");
  EXPECT_THAT(deeds(), Contains("dig far"));
}

// The first is heard at 1000 s and comes in time; so would the second, were it heard when it is sent.
TEST_P(NetworkOrders, TakeEffectOneLightTimeLater) {
  const std::string link = "links:\n  - {name: uplink, ends: [ground, lander], light_time_s: 300}\n";
  scenario("  - {at_s: 700, network: {id: early, file: ../near.htn}}\n",
           "  - network.accepted: ground/early\n  - network.in_force: ground/early\n", link);
  const Flight early = launch();
  ASSERT_EQ(early.exit_code, 0) << early.summary.dump();
  EXPECT_EQ(fault(early), "");
  EXPECT_THAT(deeds(), Not(Contains("dig far")));
  fs::remove_all(run_);
  scenario("  - {at_s: 1000, network: {id: late, file: ../near.htn}}\n",
           "  - network.refused: has begun and is not in the network\n", link);
  const Flight late = launch();
  ASSERT_EQ(late.exit_code, 0) << late.summary.dump();
  EXPECT_EQ(fault(late), "") << "the far site is committed when it is heard";
  EXPECT_THAT(deeds(), Contains("dig far"));
}

TEST_P(NetworkOrders, ANetworkOutlivesThePlanner) {
  end_sooner();
  pack("near.htn", "version: 1\n", "version: 2\n", "sets: {sites: [near, far]}", "sets: {sites: [near]}");
  scenario("  - {at_s: 600, network: {id: n2, file: ../near.htn}}\n",
           "  - network.accepted: ground/n2\n  - network.in_force: ground/n2\n");
  const std::string list = (run_ / "networks/orders.json").string();
  const Ended ended = run(
      "roci-launch " + mission_.string() + " --dds " + GetParam() +
      " --speed 400 --headless --json --scenario ground --run-folder " + run_.string() + " >" +
      (folder_ / "summary").string() + " & launcher=$!; for i in $(seq 200); do grep -qs '\"stage\": 3' " +
      list +
      " && break; sleep 0.05; done; kill -KILL $(pgrep -P $launcher planner_svc); wait $launcher; code=$?; "
      "tail -n 1 " +
      (folder_ / "summary").string() + "; exit $code");
  const json summary = last_line_as_json(ended.output);
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_EQ(summary.value("result", ""), "achieved");
  EXPECT_EQ(summary["expected"].value("fault", "no report"), "");
  EXPECT_THAT(deeds(), Not(Contains("dig far"))) << "the mission's own network would have it dug";
  EXPECT_THAT(deeds(), Contains("send near"));
}

// A planner that dies while the ground's network is in force, and its successor, which the ground asks again.
class NetworkAndDeath : public NetworkOrders {
 protected:
  std::map<std::string, Step> fly_with(const std::string& damage, const std::string& expected) const {
    scenario("", expected);  // changed.yaml is what near.htn was packed from
    for (const char* network : {"network.yaml", "changed.yaml"})
      edit(mission_ / network, "window_s: [7200, none]", "window_s: [3000, none]");
    const services::process::DomainClaim domain;
    const Ended ended = run("timeout 120 " ROCI_SOURCE_DIR "/tests/scenario/network_kill.sh ${PATH%%:*} " +
                            mission_.string() + " " + GetParam() + " " + std::to_string(domain.id()) + " " +
                            run_.string() + " " + (mission_ / "changed.yaml").string() + " " + damage);
    SCOPED_TRACE(ended.output);
    auto steps = steps_of(ended.output);
    EXPECT_EQ(steps["upload"].printed.value("stage", ""), "in force");
    EXPECT_EQ(steps["killed"].exit_code, 0);
    EXPECT_EQ(steps["launch"].exit_code, 0);
    EXPECT_EQ(steps["launch"].printed.value("result", ""), "achieved");
    EXPECT_EQ(steps["launch"].printed["expected"].value("fault", "no report"), "");
    return steps;
  }
};

TEST_P(NetworkAndDeath, ARepeatedKeyIsAnsweredWithWhereItStands) {
  auto steps = fly_with("", "");
  EXPECT_EQ(steps["repeated"].exit_code, 0);
  EXPECT_EQ(steps["repeated"].printed.value("stage", ""), "in force");
  EXPECT_EQ(steps["repeated"].printed.value("network_version", 0), 2);
  EXPECT_EQ(steps["status"].printed.size(), 2U) << "the network in force and one order";
  EXPECT_THAT(deeds(), Not(Contains("dig far")));
}

// Then it is the mission's own that is in force, and the planner knows of no order.
TEST_P(NetworkAndDeath, ADamagedNetworkIsToldAndTheMissionsOwnIsInForce) {
  auto steps = fly_with("'for network in networks/*.htn; do printf x >>$network; done'",
                        "  - \"planner.network_damaged\": \"is not what was written\"\n");
  EXPECT_NE(steps["repeated"].printed.value("stage", ""), "") << "it is an order like any other again";
}

// What people do, with `roci`: each of the three classes of R118 is one action.
// Without the value the farewell waits for ever, and without the new network the view does:
// so a plan with it is executed, however late it is heard.
TEST_P(NetworkOrders, EachClassOfTheGroundIsOneActionOfTheConsole) {
  edit(mission_ / "mission.yaml", "ground: {", "ground: {values: [lander.go], ");
  edit(mission_ / "network.yaml", "  hand: {kind: atomic}\n",
       "  hand: {kind: atomic}\n  lander.go: {kind: state, states: [wait, go], initial: wait}\n");
  edit(mission_ / "network.yaml", "    window_s: [7200, none]\n",
       "    window_s: [3000, none]\n    pre: \"lander.go = go\"\n");
  fs::copy_file(mission_ / "network.yaml", mission_ / "changed.yaml", fs::copy_options::overwrite_existing);
  edit(mission_ / "changed.yaml", "version: 1\n", "version: 2\n");
  edit(mission_ / "network.yaml", "  look:\n", "  look:\n    pre: \"lander.go = go\"\n");
  fs::copy_file(mission_ / "changed.yaml", mission_ / "broken.yaml");
  edit(mission_ / "broken.yaml", "[look, send_view]", "[look, send_everything]");
  scenario("", "");
  edit(mission_ / "scenarios/ground.yaml", "duration_s: 14400", "duration_s: 86400");
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 300 " ROCI_SOURCE_DIR "/tests/scenario/network_orders.sh ${PATH%%:*} " +
                          mission_.string() + " " + GetParam() + " " + std::to_string(domain.id()));
  auto steps = steps_of(ended.output);
  EXPECT_EQ(steps["upload"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["upload"].printed.value("stage", ""), "in force");
  EXPECT_EQ(steps["upload"].printed.value("network_version", 0), 2);
  EXPECT_EQ(steps["stale"].exit_code, 1) << ended.output;
  EXPECT_EQ(steps["stale"].printed.value("stage", ""), "refused");
  EXPECT_EQ(steps["broken"].exit_code, 2) << "it is checked before it is sent\n" << ended.output;
  EXPECT_EQ(steps["repeated"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["repeated"].printed.value("stage", ""), "in force");
  EXPECT_EQ(steps["set"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["out-of-range"].exit_code, 1) << ended.output;
  EXPECT_EQ(steps["status"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["status"].printed.size(), 5U) << "the network in force and four orders\n" << ended.output;
  EXPECT_EQ(steps["value"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["launch"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["launch"].printed.value("result", ""), "achieved");
}

INSTANTIATE_TEST_SUITE_P(Transports, NetworkAndDeath, ::testing::Values("mixed"),
                         [](const auto& dds) { return std::string(dds.param); });
INSTANTIATE_TEST_SUITE_P(Transports, NetworkOrders, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
