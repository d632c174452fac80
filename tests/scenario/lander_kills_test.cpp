// A service of the lander dies in flight and is started again: the mission ends as it would have, and nothing is done twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::StartsWith, ::testing::UnorderedElementsAre;

class LanderKills : public ::testing::TestWithParam<const char*> {
 protected:
  ~LanderKills() override { fs::remove_all(folder_); }

  // What the launcher printed, of a flight in which the service dies when the first thing has been done to the object.
  Ended fly_killing(const std::string& service, const std::string& object) {
    fs::remove_all(folder_);
    return run(
        ROCI_SOURCE_DIR
        "/tests/scenario/kill_in_flight.sh \"$(dirname \"$(command -v roci-launch)\")\" " ROCI_SOURCE_DIR
        "/tests/missions/lander " +
        std::string(GetParam()) + " " + folder_.string() + " " + service + " " + object +
        " --scenario nominal --speed 2000");
  }

  std::vector<std::string> deeds() const { return deeds_of(folder_); }

  void expect_all_done_once(const Ended& ended) const {
    EXPECT_THAT(ended.output, StartsWith("killed "));
    const json summary = last_line_as_json(ended.output);
    EXPECT_EQ(summary.value("result", ""), "achieved") << summary;
    EXPECT_THAT(deeds(), UnorderedElementsAre("dig near", "image near", "send near", "dig far", "image far",
                                              "send far", "image horizon", "send view", "farewell "));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_lander_kills_" + std::to_string(::getpid()));
};

TEST_P(LanderKills, AnEngineThatDiesGoesOnWithThePlanThatRuns) {
  for (const char* object : {"near", "view", "far"}) {
    SCOPED_TRACE(object);
    expect_all_done_once(fly_killing("planner_svc", object));
    for (const std::string& event : journaled_events(folder_ / "journal.sqlite"))
      EXPECT_FALSE(event.starts_with("plan.refused") || event.starts_with("plan.broken")) << event;
  }
}

TEST_P(LanderKills, AnExecutiveThatDiesGoesOnWithThePlanOfTheEngine) {
  for (const char* object : {"near", "view", "far"}) {
    SCOPED_TRACE(object);
    expect_all_done_once(fly_killing("exec_svc", object));
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, LanderKills, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
