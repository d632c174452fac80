// Everything that can happen to a pair within bounds is tried: never two command, nothing that was acknowledged is
// lost, nothing is flown twice or after its recall, and whenever all is mended somebody leads again.
#include "tests/unit/exec_svc/standby/pair_explorer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace roci::exec::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

// Goals, recalls, cuts, deaths, and the steps from one event to the next; ROCI_PAIR_BOUNDS names others.
std::vector<std::string> searches() {
  if (const char* const wanted = std::getenv("ROCI_PAIR_BOUNDS")) return {wanted};
  return {"1 1 1 1 2", "2 1 1 1 3", "2 1 0 2 2", "1 0 2 0 2"};
}

Bounds bounds_of(const std::string& text) {
  std::istringstream in(text);
  Bounds out;
  if (!(in >> out.goals >> out.recalls >> out.cuts >> out.kills >> out.pace) || out.pace < 1)
    throw std::invalid_argument("ROCI_PAIR_BOUNDS has five numbers, as in '2 1 2 2 3', and not '" + text + "'");
  return out;
}

class PairExplorer : public ::testing::TestWithParam<std::string> {};

TEST_P(PairExplorer, FindsNoFault) {
  const Exploration exploration = explore(bounds_of(GetParam()), Bug::none);
  EXPECT_THAT(exploration.way, IsEmpty());
  EXPECT_GT(exploration.states, 1000U);
  std::cout << exploration.states << " states, " << exploration.transitions << " transitions" << std::endl;
}

INSTANTIATE_TEST_SUITE_P(Within, PairExplorer, ::testing::ValuesIn(searches()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, ' ', '_');
  return name;
});

class Planted : public ::testing::TestWithParam<Bug> {};

TEST_P(Planted, BugIsFound) {
  Bounds bounds;
  bounds.goals = 1;
  bounds.kills = GetParam() == Bug::recall_lets_waiting_go ? 1 : 0;
  bounds.pace = 3;
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
      case Bug::recall_lets_waiting_go:
        return "recall_lets_waiting_go";
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
                                           Bug::recall_not_merged, Bug::recall_lets_waiting_go,
                                           Bug::acknowledges_early),
                         Name());

}  // namespace
}  // namespace roci::exec::testing
