#include "tests/scenario/cut_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

// Goals in this state, by the status of a flight that goes on, or by the summary of the host that led at the end.
int goals_that_are(const std::string& state, std::map<std::string, Step>& steps) {
  if (const nlohmann::json& status = steps["ended"].printed; status.is_object())
    return static_cast<int>(std::ranges::count_if(
        status["goals"], [&](const auto& goal) { return goal.value("state", "") == state; }));
  int most = 0;
  for (const char* host : {"first", "second"}) {
    const nlohmann::json& summary = steps[host].printed;
    if (summary.is_object()) most = std::max(most, summary["goals"].value(state, 0));
  }
  return most;
}

}  // namespace

void PrintTo(const Cut& cut, std::ostream* out) { *out << cut.where << " over " << cut.dds; }

void expect_nothing_lost(const Cut& cut) {
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 280 " ROCI_SOURCE_DIR "/tests/scenario/cut_pair.sh " ROCI_BINARY_DIR
          "/bin " ROCI_SOURCE_DIR "/missions/planetary " +
          std::string(cut.dds) + " " + std::to_string(domain.id()) + " " + cut.where + " " + cut.clock);
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  auto steps = steps_of(ended.output);
  for (const char* name : {"flying", "cut", "healed"})
    ASSERT_TRUE(steps[name].printed.is_object()) << name << "\n" << ended.output;
  EXPECT_EQ(steps["cut"].printed["executive"].value("leader", ""), cut.leader) << ended.output;
  EXPECT_EQ(steps["add"].exit_code, 0);
  const std::string added = steps["add"].printed.value("state", "");
  EXPECT_TRUE(added == "pending" || added == "planned") << ended.output;
  const bool merging = std::string(cut.where) == "merging";
  const bool recalls = merging || std::string(cut.where) == "leader";
  if (std::string(cut.where) != "robot" && std::string(cut.where) != "handover") {
    EXPECT_EQ(steps["add"].printed.value("acknowledged", ""), "journaled") << "by one that is alone";
  }
  if (recalls) {
    EXPECT_EQ(steps["recall"].printed.value("state", ""), "recalled") << ended.output;
    EXPECT_EQ(steps["recall"].printed.value("acknowledged", ""), "journaled");
    EXPECT_EQ(goals_that_are("recalled", steps), 1) << ended.output;
  }
  if (std::string(cut.where) == "leader") {
    EXPECT_EQ(steps["hold"].exit_code, 0) << ended.output;
    EXPECT_EQ(steps["lost"].printed, nlohmann::json(1))
        << "the order is not in force, and that is told once\n"
        << ended.output;
  }
  EXPECT_TRUE(steps["healed"].printed["executive"].value("standby_ready", false)) << ended.output;
  if (merging) {
    ASSERT_EQ(steps["died"].printed.size(), 2U) << ended.output;
    EXPECT_NE(steps["died"].printed[0], steps["died"].printed[1]) << "the executive died as it was to";
  } else {
    EXPECT_EQ(steps["healed"].printed["executive"].value("leader", ""), cut.leader) << ended.output;
  }
  if (!recalls) {
    EXPECT_EQ(goals_that_are("achieved", steps), 4) << "the three of the mission and the one of meanwhile\n"
                                                    << ended.output;
  }
  const bool stays = std::string(cut.leader) == "first";
  if (!merging && steps["led"].printed.is_array()) {
    EXPECT_EQ(steps["led"].printed, nlohmann::json({1, stays ? 0 : 1})) << "nobody else ever led\n"
                                                                        << ended.output;
  }
  expect_done_once(steps["effects"].printed);
}

}  // namespace roci::scenario
