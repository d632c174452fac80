// Everything that can happen to a pair within bounds is tried: never two command, nothing that was acknowledged is
// lost, nothing is flown twice or after its recall, and whenever all is mended somebody leads again.
#include "tests/unit/exec_svc/standby/pair_explorer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace roci::exec::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

// ROCI_PAIR_STATES bounds the states of each search; with enough of them it comes to its end.
std::size_t states_or(std::size_t few) {
  const char* const states = std::getenv("ROCI_PAIR_STATES");
  return states == nullptr ? few : std::stoull(states);
}

void expect_no_fault(const Bounds& bounds) {
  const Exploration exploration = explore(bounds, Bug::none);
  EXPECT_THAT(exploration.way, IsEmpty());
  std::cout << exploration.states << " states, " << exploration.transitions << " transitions"
            << (exploration.complete ? "" : ", not all") << std::endl;
}

TEST(PairExplorer, FindsNoFaultWithACutAndADeath) {
  Bounds bounds;
  bounds.goals = 1;
  bounds.cuts = 1;
  bounds.kills = 1;
  bounds.quiet_steps = 6;
  bounds.states = states_or(3000);
  expect_no_fault(bounds);
}

TEST(PairExplorer, FindsNoFaultWithTwoCutsAndTwoDeaths) {
  Bounds bounds;
  bounds.states = states_or(2000);
  expect_no_fault(bounds);
}

class Planted : public ::testing::TestWithParam<Bug> {};

TEST_P(Planted, BugIsFound) {
  Bounds bounds;
  bounds.goals = 1;
  bounds.cuts = 1;
  bounds.kills = 1;
  const Exploration exploration = explore(bounds, GetParam());
  EXPECT_THAT(exploration.way, Not(IsEmpty())) << exploration.states << " states";
  for (const std::string& event : exploration.way) std::cout << "  " << event << "\n";
}

// Why the lease of an owner that nobody hears is not left out (ADR 8): one split of the network is enough.
TEST(PlantedRule, ThatASilentOwnerNeedNotBeHeldIsFoundOut) {
  Bounds bounds;
  bounds.goals = bounds.recalls = bounds.kills = 0;
  bounds.cuts = 1;
  const Exploration exploration = explore(bounds, Bug::silent_owner_not_held);
  ASSERT_THAT(exploration.way, Not(IsEmpty())) << exploration.states << " states";
  EXPECT_EQ(exploration.way.back(), "two dispatch");
  for (const std::string& event : exploration.way) std::cout << "  " << event << "\n";
  EXPECT_THAT(explore(bounds, Bug::none).way, IsEmpty());
}

struct Name {
  std::string operator()(const ::testing::TestParamInfo<Bug>& test) const {
    switch (test.param) {
      case Bug::no_owner_leases:
        return "no_owner_leases";
      case Bug::goals_not_merged:
        return "goals_not_merged";
      case Bug::recall_not_merged:
        return "recall_not_merged";
      case Bug::acknowledges_early:
        return "acknowledges_early";
      case Bug::none:
      case Bug::silent_owner_not_held:
        break;
    }
    return "unnamed";
  }
};

INSTANTIATE_TEST_SUITE_P(Bugs, Planted,
                         ::testing::Values(Bug::no_owner_leases, Bug::goals_not_merged,
                                           Bug::recall_not_merged, Bug::acknowledges_early),
                         Name());

}  // namespace
}  // namespace roci::exec::testing
