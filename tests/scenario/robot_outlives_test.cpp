// What outlives the processes of a live run: the robot the one that speaks for it, and the run the network of its host.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

constexpr char kPlanetary[] = ROCI_SOURCE_DIR "/missions/planetary";

long deeds(const nlohmann::json& effects, const std::string& kind) {
  return std::ranges::count_if(effects,
                               [&](const nlohmann::json& one) { return one.value("kind", "") == kind; });
}

class RobotOutlives : public ::testing::TestWithParam<const char*> {};

// The executive knows from before that the picture is on board, and so it is: it is sent, and not taken again.
TEST_P(RobotOutlives, ItsServiceWithItsPicture) {
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 150 " ROCI_SOURCE_DIR "/tests/scenario/kill_after_picture.sh " ROCI_BINARY_DIR "/bin " +
          std::string(kPlanetary) + " " + GetParam() + " " + std::to_string(domain.id()));
  auto steps = steps_of(ended.output);
  ASSERT_TRUE(steps["killed"].printed.is_array()) << ended.output;
  EXPECT_EQ(deeds(steps["killed"].printed, "image"), 1) << ended.output;
  EXPECT_EQ(deeds(steps["killed"].printed, "send"), 0) << ended.output;
  EXPECT_EQ(steps["run"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["run"].printed.value("result", ""), "achieved") << ended.output;
  EXPECT_EQ(deeds(steps["effects"].printed, "image"), 1) << ended.output;
  EXPECT_EQ(deeds(steps["effects"].printed, "send"), 1) << ended.output;
}

INSTANTIATE_TEST_SUITE_P(Transports, RobotOutlives, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

class Resume : public ::testing::TestWithParam<const char*> {};

TEST_P(Resume, WaitsForANetworkThatIsOut) {
  const Ended ended = run("timeout 100 unshare -rn " ROCI_SOURCE_DIR
                          "/tests/scenario/resume_without_network.sh " ROCI_BINARY_DIR "/bin " +
                          std::string(kPlanetary) + " " + GetParam() + " || exit 77");
  auto steps = steps_of(ended.output);
  if (ended.exit_code == 77 && steps.empty())
    GTEST_SKIP() << "this user cannot make a network of its own (unshare -rn)";
  EXPECT_EQ(steps["waits"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["waits"].printed, "1") << "it says so once";
  EXPECT_EQ(steps["back"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["run"].exit_code, 1) << "ended by us, not for a network";
}

// Whoever writes to its domain cannot keep a run from going on; one that only begins is told to take another domain.
TEST_P(Resume, GoesOnBesideAnotherRunOnItsDomain) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 100 " ROCI_SOURCE_DIR
                          "/tests/scenario/resume_beside_another_run.sh " ROCI_BINARY_DIR "/bin " +
                          std::string(kPlanetary) + " " + GetParam() + " " + std::to_string(domain.id()));
  auto steps = steps_of(ended.output);
  EXPECT_EQ(steps["fresh"].exit_code, 2) << ended.output;
  EXPECT_THAT(steps["fresh"].printed.get<std::string>(),
              ::testing::HasSubstr("is held by another run, other"))
      << ended.output;
  const auto refused = [&](const char* step, const char* words) {
    EXPECT_EQ(steps[step].exit_code, 2) << ended.output;
    EXPECT_THAT(steps[step].printed.get<std::string>(), ::testing::HasSubstr(words)) << ended.output;
  };
  refused("another_clock", "started with --clock live");
  refused("another_scenario", "started with --scenario nominal");
  refused("damaged", "launch.json is damaged");
  EXPECT_EQ(steps["run"].exit_code, 1) << "ended by us, not refused: " << ended.output;
}

INSTANTIATE_TEST_SUITE_P(Transports, Resume, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
