// An owner of commands hangs, and the executive that leads dies with it: silence is no proof of death, so nobody
// commands until the owner is back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::HasSubstr;

class DeadOwner : public ::testing::TestWithParam<const char*> {};

TEST_P(DeadOwner, KeepsAFollowerFromCommandingUntilItIsBack) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/dead_owner.sh " ROCI_BINARY_DIR
                          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
                          std::string(GetParam()) + " " + std::to_string(domain.id()) + " 60");
  auto steps = steps_of(ended.output);
  ASSERT_TRUE(steps["flying"].printed.is_object()) << ended.output;
  ASSERT_TRUE(steps["lacks"].printed.is_string()) << ended.output;
  EXPECT_THAT(steps["lacks"].printed.dump(), HasSubstr("does not: it lacks the leases of sim_svc"));

  // The supervisor starts the owner again, one of the two leads, and all is done once.
  EXPECT_EQ(steps["launch"].exit_code, 0) << ended.output;
  ASSERT_TRUE(steps["launch"].printed.is_object()) << ended.output;
  EXPECT_EQ(steps["launch"].printed["goals"].value("achieved", 0), 3) << ended.output;
  expect_done_once(steps["effects"].printed);
}

INSTANTIATE_TEST_SUITE_P(Vendors, DeadOwner, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
