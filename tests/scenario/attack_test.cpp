// An owner of commands under attack, between real processes: an intruder on its domain who knows the run's identity.
#include "tests/scenario/attack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

class Attack : public ::testing::TestWithParam<const char*> {};

// A far query and a far command change nothing, a stranger's stop is obeyed and told of, and what the owner has taken
// is neither forgotten nor done again by the process that follows it.
TEST_P(Attack, AnOwnerKeepsItsKeysAndItsEpochOverItsDeath) {
  const Ended ended = attack("owner_under_attack.sh", GetParam());
  EXPECT_THAT(ended.output, Not(HasSubstr("nobody said")));
  EXPECT_THAT(ended.output, HasSubstr("end 0"));
  EXPECT_THAT(effects_in(ended.output), ElementsAre(Pair("image one by p1.1-image 1", 1)));
}

INSTANTIATE_TEST_SUITE_P(Transports, Attack, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
