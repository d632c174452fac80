// A service of a live run is alone on its host, whose cable is taken out in flight: nobody is given up for good, and the
// mission reaches its goals when the cable is back, each thing done once.
#include <gtest/gtest.h>

#include <string>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

struct Alone {
  const char* service;
  const char* dds;
};

void PrintTo(const Alone& alone, std::ostream* out) { *out << alone.service << " over " << alone.dds; }

class CutService : public ::testing::TestWithParam<Alone> {};

TEST_P(CutService, IsWaitedForAndTheGoalsAreReached) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 280 " ROCI_SOURCE_DIR "/tests/scenario/cut_service.sh " ROCI_BINARY_DIR
                          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
                          std::string(GetParam().dds) + " " + std::to_string(domain.id()) + " " +
                          GetParam().service + " 25");
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  auto steps = steps_of(ended.output);
  ASSERT_TRUE(steps["flying"].printed.is_object()) << ended.output;
  EXPECT_EQ(steps["missed"].exit_code, 0) << "the run was over before\n" << ended.output;
  EXPECT_EQ(steps["add"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["robot"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["other"].exit_code, 0) << ended.output;
  const bool executive_is_cut = std::string(GetParam().service) == "exec_svc";
  const nlohmann::json& summary = steps[executive_is_cut ? "other" : "robot"].printed;
  ASSERT_TRUE(summary.is_object()) << ended.output;
  EXPECT_EQ(summary.value("result", ""), "achieved") << ended.output;
  EXPECT_EQ(summary["goals"].value("achieved", 0), 4)
      << "the three of the mission and the one of meanwhile\n"
      << ended.output;
  expect_done_once(steps["effects"].printed);
}

INSTANTIATE_TEST_SUITE_P(Services, CutService,
                         ::testing::Values(Alone{"planner_svc", "fastdds"}, Alone{"planner_svc", "cyclonedds"},
                                           Alone{"exec_svc", "fastdds"}, Alone{"exec_svc", "cyclonedds"}),
                         [](const auto& test) {
                           return std::string(test.param.service) + "_" + test.param.dds;
                         });

}  // namespace
}  // namespace roci::scenario
