// A flying mission as its ground sees and commands it, while its services are killed one after the other:
// every goal is achieved all the same, and all that `roci --json` prints is JSON.
#include <gtest/gtest.h>

#include <algorithm>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

class GroundAndKills : public ::testing::TestWithParam<const char*> {};

TEST_P(GroundAndKills, NothingIsLost) {
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/ground_and_kills.sh " ROCI_BINARY_DIR
          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
          std::string(GetParam()) + " " + std::to_string(domain.id()));
  auto steps = steps_of(ended.output);
  for (const auto& [name, step] : steps) {
    const bool speaks = name != "cancel-unknown";  // else: nothing, and why on standard error
    EXPECT_EQ(step.printed.is_discarded(), !speaks) << name << "\n" << ended.output;
  }
  const auto state_after = [&](const std::string& name) { return steps[name].printed.value("state", ""); };
  EXPECT_EQ(steps["add"].exit_code, 0);
  EXPECT_TRUE(state_after("add") == "pending" || state_after("add") == "planned") << ended.output;
  EXPECT_EQ(steps["refused"].exit_code, 1);
  EXPECT_EQ(state_after("refused"), "rejected");
  EXPECT_EQ(steps["cancel-unknown"].exit_code, 1);
  EXPECT_EQ(steps["cancel"].exit_code, 0);
  EXPECT_EQ(state_after("cancel"), "recalled");
  const nlohmann::json& goals = steps["list"].printed;
  ASSERT_TRUE(goals.is_array()) << ended.output;
  const auto listed = [&](const char* id) {
    return std::ranges::count_if(goals,
                                 [id](const nlohmann::json& goal) { return goal.value("id", "") == id; });
  };
  for (const char* id : {"more", "bad", "second", "ridge", "soil", "depot"}) EXPECT_EQ(listed(id), 1) << id;
  for (const std::string service : {"exec_svc", "planner_svc", "arm_svc", "pathplan_svc"}) {
    EXPECT_EQ(steps["kill-" + service].exit_code, 0) << service << " was gone: the mission is over";
    EXPECT_EQ(steps["event-after-" + service].exit_code, 0) << service;
  }
  EXPECT_EQ(steps["status"].printed.value("mission", ""), "planetary");
  EXPECT_EQ(steps["status"].printed["goals"].size(), goals.size()) << "after the executive's restart";
  EXPECT_TRUE(steps["plan"].printed["activities"].is_array());
  EXPECT_EQ(steps["launch"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["launch"].printed.value("result", ""), "achieved");
  EXPECT_EQ(steps["launch"].printed["goals"].value("achieved", 0), 4) << steps["launch"].printed;
}

// The robot's service dies while the executive waits for it to stop: a new one takes its place, and the
// mission goes on with every goal. On the live clock, since the service is the simulated one.
TEST_P(GroundAndKills, TheRobotsServiceDiesDuringThePause) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/kill_in_pause.sh " ROCI_BINARY_DIR
                          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
                          std::string(GetParam()) + " " + std::to_string(domain.id()));
  auto steps = steps_of(ended.output);
  const auto phase = [&](const std::string& step) { return steps[step].printed.value("phase", ""); };
  EXPECT_EQ(phase("flying"), "executing") << ended.output;
  EXPECT_EQ(steps["add"].printed.value("state", ""), "pending");
  EXPECT_EQ(phase("pausing"), "pausing");
  EXPECT_EQ(phase("again"), "executing") << ended.output;
  EXPECT_GE(steps["again"].printed.value("plan_version", 0), 2);
  ASSERT_TRUE(steps["again"].printed["goals"].is_array());
  EXPECT_EQ(steps["again"].printed["goals"].size(), 4U);
  for (const nlohmann::json& goal : steps["again"].printed["goals"])
    EXPECT_EQ(goal.value("state", ""), "planned") << goal;
  EXPECT_EQ(steps["run"].printed["goals"].value("open", 0), 4)
      << "stopped in flight: " << steps["run"].printed;
  EXPECT_TRUE(steps["replay"].printed.value("same", false)) << steps["replay"].printed;
}

INSTANTIATE_TEST_SUITE_P(Transports, GroundAndKills, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Watch, WaitsForARunAndSaysSo) {
  const Ended ended =
      run("export XDG_RUNTIME_DIR=$(mktemp -d); cd $XDG_RUNTIME_DIR; "
          "timeout 60 roci watch --json >out 2>err & watcher=$!; "
          "timeout 20 sh -c 'until grep -q waiting err; do :; done'; "
          "timeout 60 roci-launch " ROCI_SOURCE_DIR
          "/missions/planetary --dds cyclonedds --speed 500 --headless >/dev/null; "
          "timeout 20 sh -c 'until grep -q planetary out; do :; done'; kill $watcher 2>/dev/null; cat err; "
          "tail -n 1 out");
  EXPECT_NE(ended.output.find("no mission runs on this machine yet; waiting for one"), std::string::npos)
      << ended.output;
  EXPECT_EQ(last_line_as_json(ended.output).value("mission", ""), "planetary") << ended.output;
}

}  // namespace
}  // namespace roci::scenario
