// The promise of the simulated clock: the same seed gives the same run, whatever the threads and the network
// do.
#include <gtest/gtest.h>

#include "services/process/domain_claim.hpp"
#include "tests/unit/services/sim_run.hpp"
#include "tests/unit/services/toy_run.hpp"

namespace roci::services {
namespace {

const std::vector<std::string> kInproc(4, "inproc");

const Trace& reference() {
  static const Trace trace = toy_run(1, kInproc, next_domain());
  return trace;
}

TEST(Determinism, SameSeedSameTraceTenTimes) {
  ASSERT_GT(reference().size(), 1000U);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(toy_run(1, kInproc, next_domain()), reference());
}

TEST(Determinism, AnotherSeedAnotherTrace) { EXPECT_NE(toy_run(2, kInproc, next_domain()), reference()); }

// Over the network: alpha, beta, delta, gamma on these vendors.
class NetworkDeterminism : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(NetworkDeterminism, SameTraceAsInOneProcess) {
  const process::DomainClaim domain;
  EXPECT_EQ(toy_run(1, GetParam(), domain.id()), reference());
}

INSTANTIATE_TEST_SUITE_P(
    Vendors, NetworkDeterminism,
    testing::Values(std::vector<std::string>(4, "fastdds"), std::vector<std::string>(4, "cyclonedds"),
                    std::vector<std::string>{"fastdds", "cyclonedds", "cyclonedds", "fastdds"}),
    [](const auto& vendors) {
      return vendors.param[0] == vendors.param[1] ? vendors.param[0] : std::string("mixed");
    });

}  // namespace
}  // namespace roci::services
