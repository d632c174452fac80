// A network that falls apart so that each executive of a pair hears a part of the owners of commands: nobody leads
// until it is whole again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>
#include <tuple>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class SplitSet : public ::testing::TestWithParam<const char*> {
 protected:
  // The convoy with a standby, and with a third owner: the scout's probe is a component,
  // for which the world itself answers.
  SplitSet() {
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/convoy", mission_, fs::copy_options::recursive);
    edit(mission_ / "mission.yaml", "{name: exec_svc}", "{name: exec_svc, standby: true}");
    edit(mission_ / "mission.yaml", "\nfamilies:",
         "  - {name: probe, timeline: scout.probe, owner: sim_svc, fallback: stop, states: {up: {}, "
         "pressing: {active: true}}}\n"
         "\nfamilies:");
  }
  ~SplitSet() override { fs::remove_all(mission_); }

  const fs::path mission_ = fs::temp_directory_path() / ("roci_split_set_" + std::to_string(::getpid()));
  const services::process::DomainClaim domain_;
};

TEST_P(SplitSet, NobodyLeadsUntilItIsWhole) {
  const Ended ended =
      run("timeout 280 " ROCI_SOURCE_DIR "/tests/scenario/split_set.sh " ROCI_BINARY_DIR "/bin " +
          mission_.string() + " " + GetParam() + " " + std::to_string(domain_.id()) + " 10");
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  auto steps = steps_of(ended.output);
  ASSERT_TRUE(steps["flying"].printed.is_object()) << ended.output;

  // The leader's plan commands both rovers, one of which it does not hear; who follows needs the scout, too.
  ASSERT_TRUE(steps["split"].printed.is_object()) << ended.output;
  EXPECT_THAT(steps["split"].printed.value("text", ""), HasSubstr("primary.locomotion")) << ended.output;
  EXPECT_TRUE(steps["lacks"].printed.is_string()) << ended.output;
  EXPECT_THAT(steps["lacks"].printed.dump(), HasSubstr("lacks the leases of scout.locomotion"));
  EXPECT_EQ(steps["nobody"].exit_code, 3) << "no executive answers that side";
  EXPECT_THAT(steps["nobody"].printed.dump(), HasSubstr("no executive leads: exec_svc (second)"));

  // What one had begun ends, and nothing else begins, though it is due.
  ASSERT_EQ(steps["untouched"].printed.size(), 2U) << ended.output;
  EXPECT_EQ(steps["untouched"].printed[0]["kind"], "drive");
  EXPECT_EQ(steps["untouched"].printed[1]["kind"], "press");

  // Then one of the two leads, the goal is achieved, and nothing is done twice.
  ASSERT_TRUE(steps["led"].printed.is_array()) << ended.output;
  if (steps["led"].printed[1] == 0) {
    EXPECT_EQ(steps["whole"].printed.value("code", ""), "lead.whole") << ended.output;
  }
  EXPECT_EQ(steps["goal"].printed.value("code", ""), "goal.achieved") << ended.output;
  std::set<std::tuple<std::string, std::string, int>> done;
  for (const json& deed : steps["effects"].printed)
    EXPECT_TRUE(
        done.emplace(deed.value("commander", ""), deed.value("activity", ""), deed.value("attempt", 0))
            .second)
        << deed;
  std::multiset<std::string> drives;
  for (const json& deed : steps["effects"].printed)
    if (deed["kind"] == "drive") drives.insert(deed.value("robot", "") + " " + deed.value("object", ""));
  EXPECT_THAT(drives, ::testing::ElementsAre("primary w1", "primary w2", "scout w1", "scout w2"));
}

INSTANTIATE_TEST_SUITE_P(Cuts, SplitSet, ::testing::Values("cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
