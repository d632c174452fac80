// A pair of executives on two hosts that is cut apart in flight, over real (virtual) cables: whoever leads
// meanwhile takes a goal in, nothing is lost when they are joined again, and nothing is done twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "services/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

struct Cut {
  const char* where;
  const char* dds;
  const char* clock;  // and speed
};

void PrintTo(const Cut& cut, std::ostream* out) { *out << cut.where << " over " << cut.dds; }

class CutPair : public ::testing::TestWithParam<Cut> {};

TEST_P(CutPair, NothingIsLostOrDoneTwice) {
  const services::DomainClaim domain;
  const Ended ended = run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/cut_pair.sh " ROCI_BINARY_DIR
                          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
                          std::string(GetParam().dds) + " " + std::to_string(domain.id()) + " " +
                          GetParam().where + " " + GetParam().clock);
  auto steps = steps_of(ended.output);
  for (const char* name : {"flying", "cut", "healed", "achieved"})
    ASSERT_TRUE(steps[name].printed.is_object()) << name << "\n" << ended.output;
  EXPECT_EQ(steps["cut"].printed["executive"].value("leader", ""), "second") << ended.output;
  EXPECT_EQ(steps["add"].exit_code, 0);
  EXPECT_NE(steps["add"].printed.value("state", ""), "rejected");
  EXPECT_TRUE(steps["healed"].printed["executive"].value("standby_ready", false)) << ended.output;
  for (const char* host : {"robot", "first", "second"}) EXPECT_TRUE(steps[host].printed.is_object()) << host;
  const nlohmann::json& goals = steps["achieved"].printed["goals"];
  EXPECT_EQ(
      std::ranges::count_if(goals, [](const auto& goal) { return goal.value("state", "") == "achieved"; }), 4)
      << "the three of the mission and the one of meanwhile\n"
      << ended.output;
  ASSERT_TRUE(steps["begun"].printed.is_array());
  std::set<std::pair<std::string, int>> begun;
  for (const nlohmann::json& command : steps["begun"].printed)
    EXPECT_TRUE(begun.emplace(command.value("activity", ""), command.value("attempt", 0)).second) << command;
}

// Who is cut off from the simulated clock for good has lost the run, so a host's own cuts are flown live.
INSTANTIATE_TEST_SUITE_P(
    Cuts, CutPair,
    ::testing::Values(Cut{"between", "cyclonedds", "simulated 400"}, Cut{"between", "mixed", "simulated 400"},
                      Cut{"first", "mixed", "live 120"}, Cut{"second", "mixed", "live 120"}),
    [](const auto& test) { return std::string(test.param.where) + "_" + test.param.dds; });

}  // namespace
}  // namespace roci::scenario
