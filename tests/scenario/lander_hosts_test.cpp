// A lander whose planner and ground stand on hosts of their own (network namespaces), on each vendor and mixed: it
// flies as on one host, and the ground reaches the planner. Built twice: with the small lander for ./check, with the
// Europa lander for ./check --full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;

class LanderHosts : public ::testing::TestWithParam<const char*> {
 protected:
  ~LanderHosts() override { fs::remove_all(folder_); }

  // The steps of lander_hosts.sh; none where namespaces are not permitted.
  static std::map<std::string, Step> fly_apart(const std::string& mission, const std::string& scenario,
                                               const std::string& speed, const std::string& network = "") {
    const services::process::DomainClaim domain;
    const Ended ended =
        run(ROCI_SOURCE_DIR "/tests/scenario/lander_hosts.sh ${PATH%%:*} " + mission + " " + GetParam() +
            " " + std::to_string(domain.id()) + " " + scenario + " " + speed + " " + network);
    if (ended.exit_code == 77) return {};
    return steps_of(ended.output);
  }
  static void expect_flown(std::map<std::string, Step>& steps) {
    EXPECT_EQ(steps["heard"].exit_code, 0) << "the ground hears the flight";
    EXPECT_EQ(steps["lander"].exit_code, 0) << steps["lander"].printed;
    EXPECT_EQ(steps["lander"].printed.value("result", ""), "achieved");
    EXPECT_EQ(steps["planner"].exit_code, 0) << steps["planner"].printed;
  }
  static void expect_the_trace_of_one_host(const std::string& mission, const std::string& scenario) {
    auto steps = fly_apart(mission, scenario, "max");
    if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
    expect_flown(steps);
    EXPECT_EQ(steps["lander"].printed.value("trace_sha256", ""),
              reference_trace(mission, "--scenario " + scenario));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_lander_hosts_" + std::to_string(::getpid()));
};

#ifdef ROCI_ALL_SCENARIOS

TEST_P(LanderHosts, FlyTheEuropaLanderAsOneHostDoes) {
  expect_the_trace_of_one_host(ROCI_SOURCE_DIR "/missions/europa", "all_negative");
}

#else

TEST_P(LanderHosts, FlyAsOneHostDoes) {
  expect_the_trace_of_one_host(ROCI_SOURCE_DIR "/tests/missions/lander", "nominal");
}

TEST_P(LanderHosts, ANetworkOfTheGroundReachesThePlanner) {
  const fs::path mission = folder_ / "lander";
  fs::create_directories(folder_);
  fs::copy(ROCI_SOURCE_DIR "/tests/missions/lander", mission, fs::copy_options::recursive);
  std::ofstream(mission / "mission.yaml", std::ios::app) << "ground: {uploads: [network]}\n";
  fs::copy_file(mission / "network.yaml", mission / "next.yaml");
  edit(mission / "next.yaml", "version: 1\n", "version: 2\n");
  auto steps = fly_apart(mission.string(), "nominal", "1000", (mission / "next.yaml").string());
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  expect_flown(steps);
  EXPECT_EQ(steps["upload"].exit_code, 0) << steps["upload"].printed;
  EXPECT_EQ(steps["status"].exit_code, 0) << steps["status"].printed;
  EXPECT_THAT(steps["status"].printed.dump(), ::testing::HasSubstr("\"n2\""));
  EXPECT_THAT(steps["status"].printed.dump(), ::testing::HasSubstr("in force"));
}

#endif

INSTANTIATE_TEST_SUITE_P(Vendors, LanderHosts, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
