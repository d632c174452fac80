// A service of the lander dies in flight and is started again: the mission ends as it would have,
// and nothing is done twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
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
  ~LanderKills() override {
    fs::remove_all(folder_);
    fs::remove_all(mission_);
  }

  // What the launcher printed, of a flight in which the service dies when the first thing has been done to the object.
  Ended fly_killing(const std::string& service, const std::string& object,
                    const fs::path& mission = ROCI_SOURCE_DIR "/tests/missions/lander",
                    const std::string& scenario = "nominal") {
    fs::remove_all(folder_);
    return run(ROCI_SOURCE_DIR
               "/tests/scenario/kill_in_flight.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
               mission.string() + " " + std::string(GetParam()) + " " + folder_.string() + " " + service +
               " " + object + " --scenario " + scenario + " --speed 2000");
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
  const fs::path mission_ = folder_.string() + "_mission";
};

TEST_P(LanderKills, AnEngineThatDiesGoesOnWithThePlanThatRuns) {
  for (const char* object : {"near", "view", "far"}) {
    SCOPED_TRACE(object);
    expect_all_done_once(fly_killing("planner_svc", object));
    for (const char* record : {"1.steps", "2.steps"}) {  // one of each process
      const Ended again = run("roci-network cycle " + (folder_ / "planner_steps" / record).string());
      EXPECT_EQ(again.exit_code, 0) << again.output;
    }
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

// Two trenches, of which nobody but the planner knows what became: the farewell waits for one. The executive dies when
// it is open, and tells nothing of it that is no longer so.
TEST_P(LanderKills, AnExecutiveThatDiesTakesBackNothingThatTasksHaveMade) {
  fs::remove_all(mission_);
  fs::copy(ROCI_SOURCE_DIR "/tests/missions/lander", mission_, fs::copy_options::recursive);
  const fs::path network = mission_ / "network.yaml";
  edit(network, "of: \"{site}\"", "of: \"picture_{site}\"");
  edit(network, "window_s: [7200, none]", "window_s: [7200, none]\n    pre: \"trench_near = open\"");
  const Ended ended = fly_killing("exec_svc", "picture_near", mission_);
  EXPECT_THAT(ended.output, StartsWith("killed "));
  EXPECT_EQ(last_line_as_json(ended.output).value("result", ""), "achieved") << ended.output;
}

// A lander whose digging holds the next one until the ground lets it go. The executive dies between the hold and the
// ground's second word: what it tells of the first one, when it is there again, releases nothing.
TEST_P(LanderKills, AnExecutiveThatDiesKeepsAHoldThatCameAfterTheGroundsWord) {
  fs::remove_all(mission_);
  fs::copy(ROCI_SOURCE_DIR "/tests/missions/lander", mission_, fs::copy_options::recursive);
  edit(mission_ / "mission.yaml", "model: network.yaml\n", "model: network.yaml\nground: {values: [hold]}\n");
  const fs::path network = mission_ / "network.yaml";
  edit(network, "  hand: {kind: atomic}\n",
       "  hand: {kind: atomic}\n  hold: {kind: state, states: [clear, held], initial: held, reported: "
       "false}\n");
  edit(network, "\"lander.lamp = lit\"]", "\"lander.lamp = lit\", \"hold = clear\"]");
  edit(network, "      trench_{site}: {set: open, at: end}\n",
       "      trench_{site}: {set: open, at: end}\n      hold: {set: held, at: end}\n");
  edit(network, "of: \"{site}\"", "of: \"picture_{site}\"");
  edit(network, "window_s: [7200, none]", "window_s: [11000, none]");
  std::ofstream(mission_ / "scenarios/holds.yaml")
      << "duration_s: 14400\nstart: {battery: 600000}\nstimuli:\n"
         "  - {at_s: 10, goal: {id: network, kind: mission, importance: hard}}\n"
         "  - {at_s: 300, set: {id: first, timeline: hold, value: clear}}\n"
         "  - {at_s: 8000, set: {id: second, timeline: hold, value: clear}}\n";
  const Ended ended = fly_killing("exec_svc", "picture_near", mission_, "holds");
  EXPECT_THAT(ended.output, StartsWith("killed "));
  EXPECT_EQ(last_line_as_json(ended.output).value("result", ""), "achieved") << ended.output;
  std::vector<double> digs;
  std::ifstream in(folder_ / "effects.jsonl");
  for (std::string line; std::getline(in, line);)
    if (const auto deed = json::parse(line); deed["kind"] == "dig")
      digs.push_back(deed["time_us"].get<double>() / 1e6);
  ASSERT_EQ(digs.size(), 2U);
  EXPECT_GT(digs[0], 300);
  EXPECT_LT(digs[0], 8000);
  EXPECT_GT(digs[1], 8000) << "the ground had not let it go";
}

INSTANTIATE_TEST_SUITE_P(Transports, LanderKills, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
