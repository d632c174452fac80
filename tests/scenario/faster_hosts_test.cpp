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

// Apart for longer than the executive waits for a scout that drove: it says what is missing,
// and the run ends with both goals open.
TEST_P(FasterHostsOf, EndAsStatedWhenApartForLonger) {
  const fs::path mission = sooner(folder_ / "faster");
  edit(mission / "mission.yaml", "fallback_timeout_s: 600", "fallback_timeout_s: 60");
  auto steps = fly_apart(GetParam(), mission.string(), "live 20", "w3 1000");
  if (steps.empty()) GTEST_SKIP() << "this user cannot make network namespaces (ip netns add)";
  EXPECT_EQ(steps["primary"].exit_code, 1);
  EXPECT_EQ(steps["primary"].printed.value("result", ""), "failed") << steps["primary"].printed;
  EXPECT_EQ(steps["primary"].printed["goals"].value("open", 0), 2);
  EXPECT_THAT(events(), Contains(AllOf(StartsWith("robot.safing"),
                                       HasSubstr("fall-back of scout_locomotion is not answered"))));
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

#endif

INSTANTIATE_TEST_SUITE_P(Vendors, FasterHostsOf, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
