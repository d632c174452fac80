// The two rovers of missions/faster and their ground on three hosts (network namespaces), on each vendor and with the
// rovers on different ones (R128, R129). Built twice: for ./check with the trace of one host, for ./check --full live,
// with the link between the rovers down for minutes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf, ::testing::Contains, ::testing::HasSubstr, ::testing::Not, ::testing::StartsWith;

constexpr char kMission[] = ROCI_SOURCE_DIR "/missions/faster";

class FasterHosts : public ::testing::Test {
 protected:
  FasterHosts() { fs::create_directories(folder_ / "hosts"); }
  ~FasterHosts() override { fs::remove_all(folder_); }

  // The steps of faster_hosts.sh; none where namespaces are not permitted.
  std::map<std::string, Step> fly_apart(const std::string& dds, const std::string& mission,
                                        const std::string& clock, const std::string& more = "") const {
    const services::process::DomainClaim domain;
    const Ended ended =
        run(ROCI_SOURCE_DIR "/tests/scenario/faster_hosts.sh ${PATH%%:*} " + mission + " " + dds + " " +
            std::to_string(domain.id()) + " " + (folder_ / "hosts").string() + " " + clock + " " + more);
    if (ended.exit_code == 77) return {};
    return steps_of(ended.output);
  }

  // Both goals are achieved, and no primary was in soil that does not bear it.
  void expect_arrived(const Step& primary) const {
    EXPECT_EQ(primary.printed.value("result", ""), "achieved") << primary.printed;
    EXPECT_EQ(primary.printed.value("goals", json::object()).value("achieved", 0), 2);
    EXPECT_THAT(events(), Not(Contains(HasSubstr("bogged-down"))));
  }
  void expect_nothing_done_twice() const {
    std::vector<std::string> keys;
    std::istringstream lines(text_of(folder_ / "hosts/ground/effects.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const json deed = json::parse(line);
      keys.push_back(deed["commander"].get<std::string>() + " " + deed["activity"].get<std::string>() + " " +
                     deed["attempt"].dump());
    }
    EXPECT_FALSE(keys.empty());
    std::ranges::sort(keys);
    EXPECT_TRUE(std::ranges::adjacent_find(keys) == keys.end());
  }
  std::vector<std::string> events() const {
    return journaled_events(folder_ / "hosts/primary/journal.sqlite");
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_faster_hosts_" + std::to_string(::getpid()));
};

class FasterHostsOf : public FasterHosts, public ::testing::WithParamInterface<const char*> {};

std::string trace_of_one_host() {
  static const std::string trace =
      fly(kMission, "inproc", 1, "--scenario trial").summary.value("trace_sha256", "none");
  return trace;
}

// The mission with its last communication sooner, an hour's wait is no part of this, and at the level that it begins
// with: at E3 what breaks waits for the ground.
fs::path sooner(const fs::path& folder) {
  fs::copy(kMission, folder, fs::copy_options::recursive);
  edit(folder / "mission.yaml", "[3600, 5400]", "[1800, 5400]");
  edit(folder / "scenarios/trial.yaml", "opens_s: 3600", "opens_s: 1800");
  edit(folder / "scenarios/trial.yaml", "  - {at_s: 5, order: {id: level, kind: autonomy, level: E3}}",
       "  #");
  return folder;
}

#ifdef ROCI_CUT

// A rover without its vendor's transport is refused before it says a word; when it has it, the mission begins. A second
// dedicated executive of one name is refused in flight, which goes on as if nobody had tried.
TEST_F(FasterHosts, RefuseAMissingVendorAndASecondOfOneName) {
  auto steps = fly_apart("mixed", kMission, "simulated 200", "refused");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  EXPECT_EQ(steps["bare"].exit_code, 3);
  EXPECT_THAT(
      text_of(folder_ / "hosts/bare.said"),
      AllOf(HasSubstr("unknown DDS transport \"cyclonedds\"; installed: fastdds"), HasSubstr("--dds")));
  EXPECT_EQ(steps["second"].exit_code, 2);
  EXPECT_THAT(text_of(folder_ / "hosts/second.said"),
              HasSubstr("run \"faster\" has a scout.locomotion already; end it"));
  expect_arrived(steps["primary"]);
  expect_nothing_done_twice();
  EXPECT_EQ(steps["primary"].printed.value("trace_sha256", ""), trace_of_one_host());
}

// For five minutes, while the scout drives, it and the executive do not hear each other. It ends its drive, the plan
// breaks, and when the link is back the two go on by a new plan.
TEST_P(FasterHostsOf, GoOnAfterMinutesApart) {
  auto steps = fly_apart(GetParam(), sooner(folder_ / "faster").string(), "live 20", "w3 300");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  EXPECT_EQ(steps["heard"].exit_code, 0) << "the ground hears the flight";
  expect_arrived(steps["primary"]);
  ASSERT_TRUE(steps["cut"].printed.is_number() && steps["healed"].printed.is_number());
  EXPECT_GE(steps["healed"].printed.get<int>() - steps["cut"].printed.get<int>(), 300);
  EXPECT_THAT(events(), Contains(StartsWith("service.lost scout.locomotion")));
  EXPECT_THAT(events(), Contains(HasSubstr("owner scout.locomotion is lost")));
  expect_nothing_done_twice();
}

// Apart for longer than a scout may be silent, and than the executive waits for it to rest: the run does not end, the
// scout counts as lost, the ground is told, and the primary arrives alone. That the scout is heard again later changes
// nothing of it.
TEST_P(FasterHostsOf, ThePrimaryArrivesAloneWhenApartForLonger) {
  const fs::path mission = sooner(folder_ / "faster");
  edit(mission / "mission.yaml", "fallback_timeout_s: 600", "fallback_timeout_s: 60");
  auto steps = fly_apart(GetParam(), mission.string(), "live 20", "w3 1000");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  expect_arrived(steps["primary"]);
  EXPECT_THAT(events(), Contains(AllOf(StartsWith("robot.safing"),
                                       HasSubstr("fall-back of scout_locomotion is not answered"))));
  EXPECT_THAT(events(), Contains(StartsWith("component.lost scout_locomotion counts as lost")));
  expect_nothing_done_twice();
}

#else

TEST_P(FasterHostsOf, FlyAsOneHostDoes) {
  auto steps = fly_apart(GetParam(), kMission, "simulated max");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  EXPECT_EQ(steps["heard"].exit_code, 0) << "the ground hears the flight";
  expect_arrived(steps["primary"]);
  expect_nothing_done_twice();
  EXPECT_EQ(steps["ground"].printed["expected"].value("fault", "no report"), "");
  for (const char* host : {"ground", "primary", "scout"})
    EXPECT_EQ(steps[host].exit_code, 0) << host << " " << steps[host].printed;
  EXPECT_EQ(steps["primary"].printed.value("trace_sha256", ""), trace_of_one_host());
}

// R137: all that runs on the scout's host dies for good while it drives. Its steps fail with the cause, the ground is
// told when it counts as lost, and the primary arrives alone (Traverse-PR).
TEST_F(FasterHosts, AScoutWhoseHostDiesCountsAsLostAndThePrimaryArrivesAlone) {
  auto steps = fly_apart("mixed", sooner(folder_ / "faster").string(), "simulated 400", "dead w2");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  expect_arrived(steps["primary"]);
  EXPECT_EQ(steps["scout"].exit_code, 137) << "killed, and not started again";
  const std::vector<std::string> all = events();
  auto at = all.begin();
  for (const char* part :
       {"service.lost scout.", "plan.broken", "component.lost scout_locomotion counts as lost",
        "plan.adopted", "long_traverse achieved", "last_communication achieved"}) {
    at = std::find_if(at, all.end(),
                      [&](const std::string& one) { return one.find(part) != std::string::npos; });
    ASSERT_NE(at, all.end()) << part;
    if (std::string(part) == "plan.broken") {
      EXPECT_THAT(*at, ::testing::ContainsRegex("lost|not answered"));
    }
  }
  const std::string told = text_of(folder_ / "hosts/told");
  EXPECT_LT(told.find("component.lost"), told.find("long_traverse achieved")) << told;
  EXPECT_NE(told.find("long_traverse achieved"), std::string::npos);
  const std::string trace =
      run("roci-trace print " + (folder_ / "hosts/primary/journal.sqlite").string()).output;
  EXPECT_THAT(trace, HasSubstr("GoAlone from="));
  std::istringstream lines(text_of(folder_ / "hosts/ground/effects.jsonl"));
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    const json deed = json::parse(line);
    if (deed["kind"] == "motion")
      last = deed["robot"].get<std::string>() + " " + deed["object"].get<std::string>();
    EXPECT_FALSE(deed["robot"] == "scout" && deed["object"] == "w9") << deed;
  }
  EXPECT_EQ(last, "primary w9");
  expect_nothing_done_twice();
}

// R128, level E4: goals go up, and the planner runs beside the executive; the flight is the same.
TEST_F(FasterHosts, FlyAsOneHostDoesWithThePlannerOnThePrimary) {
  auto steps = fly_apart("mixed", kMission, "simulated max", "planner primary");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  expect_arrived(steps["primary"]);
  EXPECT_TRUE(fs::exists(folder_ / "hosts/primary/planner_calls")) << "it was asked there";
  EXPECT_FALSE(fs::exists(folder_ / "hosts/ground/planner_calls"));
  EXPECT_EQ(steps["primary"].printed.value("trace_sha256", ""), trace_of_one_host());
}

#endif

INSTANTIATE_TEST_SUITE_P(Vendors, FasterHostsOf, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
