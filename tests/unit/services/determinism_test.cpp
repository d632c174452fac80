// The promise of the simulated clock: the same seed gives the same run, whatever the threads do.
#include <gtest/gtest.h>

#include "tests/unit/services/sim_run.hpp"
#include "tests/unit/services/toy_run.hpp"

namespace roci::services {
namespace {

const std::vector<std::string> kInproc(4, "inproc");

TEST(Determinism, SameSeedSameTraceTenTimes) {
  const Trace first = toy_run(1, kInproc, next_domain());
  ASSERT_GT(first.size(), 1000U);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(toy_run(1, kInproc, next_domain()), first);
}

TEST(Determinism, AnotherSeedAnotherTrace) {
  EXPECT_NE(toy_run(1, kInproc, next_domain()), toy_run(2, kInproc, next_domain()));
}

}  // namespace
}  // namespace roci::services
