// The planetary mission across two hosts (network namespaces), on each vendor and mixed.
#include <gtest/gtest.h>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

struct Hosts {
  const char* name;
  const char* robot;
  const char* ground;
  int domain;
};

class TwoHostsTest : public ::testing::TestWithParam<Hosts> {};

TEST_P(TwoHostsTest, AGoalSentAcrossIsAchievedWithTheOthers) {
  const Hosts& hosts = GetParam();
  const Ended ended =
      run(std::string(ROCI_SOURCE_DIR) +
          "/tests/scenario/two_hosts.sh " ROCI_BINARY_DIR "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
          hosts.robot + " " + hosts.ground + " " + std::to_string(hosts.domain));
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  EXPECT_EQ(ended.exit_code, 0);
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "achieved") << ended.output;
  EXPECT_EQ(summary["goals"].value("achieved", 0), 4) << ended.output;
}

INSTANTIATE_TEST_SUITE_P(Vendors, TwoHostsTest,
                         ::testing::Values(Hosts{"fastdds", "fastdds", "fastdds", 71},
                                           Hosts{"cyclonedds", "cyclonedds", "cyclonedds", 72},
                                           Hosts{"mixed", "fastdds", "cyclonedds", 73}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
