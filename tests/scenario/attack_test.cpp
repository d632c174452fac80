// An owner of commands under attack, between real processes: an intruder on its domain who knows the run's identity.
#include "tests/scenario/attack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/effects.hpp"

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
  const nlohmann::json effects = effects_in(ended.output);
  expect_done_once(effects);
  EXPECT_THAT(deeds_counted(effects), ElementsAre(Pair("image one", 1)));
}

INSTANTIATE_TEST_SUITE_P(Transports, Attack, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
