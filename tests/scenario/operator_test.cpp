// What an operator asks of a mission while it flies, typed into roci: plan, timelines, ways, why the plan is as it
// is, how a goal ends, and which runs there are. Three flights serve all of it: two are begun, asked, and ended
// before their time; one ends by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// The planetary mission whose domain has one more action, which reads and raises a number that nobody gives, and three
// scenarios: the ground asks for everything, an obstacle becomes known far from every way, and one that ends before the
// first communication window.
fs::path made_mission(const fs::path& folder) {
  fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder / "mission", fs::copy_options::recursive);
  edit(folder / "mission/domain.pddl", "(:functions (battery)", "(:functions (warmth) (battery)");
  edit(folder / "mission/domain.pddl", "  (:durative-action drive",
       "  (:durative-action beam :parameters (?i - image) :duration (= ?duration 5)\n"
       "    :condition (and (at start (have-image ?i)) (at start (<= (warmth) 3)))\n"
       "    :effect (and (at end (sent ?i)) (at end (increase (warmth) 1))))\n\n"
       "  (:durative-action drive");
  edit(folder / "mission/mission.yaml", "actions:\n",
       "actions:\n  beam: {owner: sim_svc, component: radio, command: send, arguments: {image: \"?1\"}}\n");
  std::ofstream(folder / "mission/scenarios/asked.yaml")
      << "description: The ground asks.\nduration_s: 3600\n"
         "start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}\nscience: {enabled: false}\n";
  for (const char* scenario : {"obstacle.yaml", "ended.yaml"})
    fs::copy(folder / "mission/scenarios/asked.yaml", folder / "mission/scenarios" / scenario);
  edit(folder / "mission/scenarios/ended.yaml", "duration_s: 3600", "duration_s: 800");
  std::ofstream(folder / "mission/scenarios/obstacle.yaml", std::ios::app)
      << "stimuli:\n"
         "  - {at_s: 10, goal: {id: ridge, kind: photo, importance: hard, arguments: {x: 110, y: 60}}}\n"
         "  - {at_s: 10, goal: {id: soil, kind: photo, importance: hard, arguments: {x: 80, y: 75}}}\n"
         "  - {at_s: 60, hazard: {id: far, x: 220, y: 20, radius: 2}}\n";
  return folder / "mission";
}

class Operator : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("roci_operator_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    const fs::path mission = made_mission(folder_);
    for (const std::string flight : {"asked", "obstacle", "ended"}) {
      const services::process::DomainClaim domain;
      ended_ = run("timeout 120 " ROCI_SOURCE_DIR "/tests/scenario/operator.sh ${ROCI_BIN:-" ROCI_BINARY_DIR
                   "/bin} " +
                   mission.string() + " " + flight + " cyclonedds " + std::to_string(domain.id()) + " " +
                   (folder_ / flight).string() + (flight == "ended" ? " 100 " : " 20 ") + flight + " 2>&1");
    }
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string said(const std::string& name) { return text_of(folder_ / "asked" / name); }
  static int code(const std::string& name) {
    const std::string text = said(name + ".code");
    return text.empty() ? -1 : std::stoi(text);
  }
  static json parsed(const std::string& name) { return json::parse(said(name), nullptr, false); }
  static int events(const std::string& event_code) {
    int out = 0;
    std::istringstream lines(said("events"));
    for (std::string line; std::getline(lines, line);)
      out += json::parse(line, nullptr, false).value("code", "") == event_code ? 1 : 0;
    return out;
  }

  static inline fs::path folder_;
  static inline Ended ended_;
};

TEST_F(Operator, SeesThePlanAsATable) {
  EXPECT_EQ(code("plan"), 0) << ended_.output;
  EXPECT_THAT(said("plan"), ContainsRegex("plan 1, from 00:0[0-9]:[0-9]+, now 00:[0-9]"));
  EXPECT_THAT(said("plan"), HasSubstr("ACTIVITY"));
  EXPECT_THAT(said("plan"),
              ContainsRegex("p1\\.1-drive +drive +to=place-[a-z]+ x=[0-9]+ y=[0-9]+ +running "));
  EXPECT_THAT(said("plan"), ContainsRegex("take-image +image=image-[a-z]+ +waiting .*ground/"));
  const json plan = parsed("plan.json");
  EXPECT_EQ(plan.value("version", 0), 1);
  EXPECT_EQ(plan["activities"][0]["arguments"].size(), 3U) << "to, x and y: " << plan.dump();
  EXPECT_EQ(plan["activities"][0].value("older_values", true), false);
}

TEST_F(Operator, SeesTimelinesOnceEachWithTheirUnits) {
  EXPECT_EQ(code("timelines"), 0);
  EXPECT_THAT(said("timelines"), HasSubstr("PROJECTED LAST"));
  EXPECT_THAT(said("timelines"), ContainsRegex("\nrover\\.battery +[0-9.]+ .* J\n"));
  EXPECT_THAT(said("timelines"), ContainsRegex("\nrover\\.x +[0-9.]+ .* m\n"));
  EXPECT_THAT(said("timelines"), ContainsRegex("\nrover\\.nav +going-to\\(place-[a-z]+\\)"));
  int rows = 0;
  std::istringstream lines(said("timelines"));
  for (std::string line; std::getline(lines, line);) rows += line.starts_with("rover.battery ") ? 1 : 0;
  EXPECT_EQ(rows, 1);
}

TEST_F(Operator, IsToldWhetherThereIsAWay) {
  EXPECT_EQ(code("there"), 0) << said("there.err");
  const json way = parsed("there");
  EXPECT_EQ(way.value("outcome", ""), "found");
  EXPECT_EQ(way.value("map_version", 0), 1);
  EXPECT_GT(way.value("length_m", 0.0), 30);
  EXPECT_GT(way.value("expected_s", 0.0), 300);
  EXPECT_GT(way.value("expected_j", 0.0), 1000);
  EXPECT_EQ(code("steep"), 1);
  EXPECT_THAT(said("steep"), ContainsRegex("^no way from x=.* to x=190 y=60: .* \\(map 1\\)\n$"));
  EXPECT_EQ(code("outside"), 1);
  EXPECT_THAT(said("outside"), HasSubstr("the place lies outside the map"));
}

TEST_F(Operator, SeesTheValuesThatAnActivityStandsOn) {
  EXPECT_EQ(code("why"), 0) << said("why.err");
  EXPECT_THAT(said("why"),
              ContainsRegex(
                  "traverse_time +here place-[a-z]+ +[0-9.]+ s +exact +pathplan_svc +1 +00:0[0-9]:[0-9]+ "));
  EXPECT_THAT(said("why"), HasSubstr("traverse_energy"));
  EXPECT_THAT(said("why"), Not(HasSubstr("arm_move")));
  const json drive = parsed("why.json");
  ASSERT_EQ(drive.size(), 1U) << drive.dump();
  const json& values = drive[0]["function_values"];
  ASSERT_EQ(values.size(), 2U) << "time and energy of this way alone: " << values.dump();
  for (const json& value : values) {
    EXPECT_EQ(value.value("owner", ""), "pathplan_svc");
    EXPECT_EQ(value.value("model_version", 0), 1);
    EXPECT_EQ(value.value("model_version_now", 0), 1);
    EXPECT_EQ(value["arguments"][0], "here");
    EXPECT_GT(value.value("age_s", -1.0), 0);
  }
  EXPECT_EQ(code("nothing"), 1);
  EXPECT_THAT(said("nothing.err"),
              HasSubstr("the running plan has no activity 'dance'; roci plan lists them"));
}

// The obstacle is seen, the map gets its next version, and what was planned on the one before is marked
// until it is planned anew.
TEST_F(Operator, SeesWhichActivitiesStandOnAnOlderMap) {
  EXPECT_THAT(text_of(folder_ / "obstacle/older"), ContainsRegex("drive [^\n]* waiting \\*"));
  EXPECT_THAT(text_of(folder_ / "obstacle/older"), Not(ContainsRegex("take-image[^\n]* waiting \\*")))
      << "asks no path planner";
  EXPECT_THAT(text_of(folder_ / "obstacle/older"),
              ContainsRegex("\n\\* stands on values of version 1 of pathplan_svc's model, which has "
                            "version 2 now; roci plan --why p[0-9.]+-drive shows them\n"));
  const json drives = json::parse(text_of(folder_ / "obstacle/older.json"), nullptr, false);
  bool older = false;
  for (const json& drive : drives)
    for (const json& value : drive["function_values"])
      older |= value.value("model_version", 0) == 1 && value.value("model_version_now", 0) == 2;
  EXPECT_TRUE(older) << drives.dump();
  const auto told = journaled_events(folder_ / "obstacle/run/journal.sqlite");
  EXPECT_EQ(
      std::ranges::count_if(told, [](const auto& event) { return event.starts_with("values.outdated "); }), 1)
      << ::testing::PrintToString(told);
  EXPECT_THAT(told, ::testing::Contains(ContainsRegex(
                        "values.outdated plan 1 stands on values of an older model: "
                        "pathplan_svc has version 2 now, the values of p1.*-drive are of version 1")));
}

// Both problems lack the number; the planner says so once.
TEST_F(Operator, IsWarnedOnceOfANumberThatHasNoValue) {
  EXPECT_EQ(code("second"), 0) << said("second.err");
  EXPECT_THAT(said("after"), HasSubstr("ground/second"));
  EXPECT_THAT(said("after"), HasSubstr("plan 2,"));
  EXPECT_EQ(events("planner.warning"), 1) << said("events");
  EXPECT_THAT(said("events"), HasSubstr("(warmth) has no initial value"));
}

// Steep ground lies around the place.
TEST_F(Operator, IsToldThatAGoalWasGivenUp) {
  EXPECT_EQ(code("steep-goal"), 4) << said("steep-goal.err");
  EXPECT_THAT(said("steep-goal"), HasSubstr("ground/steep"));
  EXPECT_THAT(said("steep-goal"), ContainsRegex("dropped.* out of reach: place-steep \\(x=190 y=60\\)"));
}

TEST_F(Operator, IsToldThatTheMissionEndedBeforeTheGoal) {
  EXPECT_EQ(text_of(folder_ / "ended/open-goal.code"), "5\n") << text_of(folder_ / "ended/open-goal.err");
  EXPECT_THAT(text_of(folder_ / "ended/open-goal"), HasSubstr("ground/open"));
  EXPECT_THAT(text_of(folder_ / "ended/open-goal.err"), HasSubstr("the mission ended before goal open did"));
}

// Two runs are old, one flies, and one folder is no run.
TEST_F(Operator, ClearsOldRunsAwayButNoneThatFlies) {
  const auto names = [](const std::string& file) {
    std::vector<std::string> out;
    for (const json& one : parsed(file)) out.push_back(fs::path(one.value("folder", "")).filename());
    return out;
  };
  EXPECT_THAT(names("runs"),
              ElementsAre("20990101T000000Z-flight", "20260102T000000Z-older", "20260101T000000Z-old"));
  EXPECT_EQ(parsed("runs")[0].value("result", ""), "running");
  EXPECT_THAT(names("pruned"), ElementsAre("20260102T000000Z-older", "20260101T000000Z-old"));
  EXPECT_THAT(said("pruned-again"), HasSubstr("nothing to remove in "));
  EXPECT_EQ(said("kept"), "20990101T000000Z-flight\nno-run-of-a-launcher\n");
}

}  // namespace
}  // namespace roci::scenario
