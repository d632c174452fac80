// A search that is under way when its time on the wall is over (planner.budget.wall_s: 60 s on a robot, 1 s here), in
// flight on the live clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

// The planetary mission with two counters, one of even and one of odd numbers. That they are never equal the planner
// cannot prove, so that it searches until it is stopped.
class PlannerTimeout : public ::testing::TestWithParam<const char*> {
 protected:
  PlannerTimeout() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder / "mission", fs::copy_options::recursive);
    const fs::path mission = folder / "mission/mission.yaml";
    edit(mission, "budget: {work: 4000, memory_mb: 256, wall_s: 60}", "budget: {memory_mb: 1024, wall_s: 1}");
    edit(mission, "fluents:\n",
         "fluents:\n  - {fluent: \"(even)\", value: 0}\n  - {fluent: \"(odd)\", value: 1}\n");
    edit(mission, "actions:\n",
         "actions:\n"
         "  count-even: {owner: sim_svc, component: camera, command: image, arguments: {image: \"?1\"}}\n"
         "  count-odd: {owner: sim_svc, component: camera, command: image, arguments: {image: \"?1\"}}\n");
    edit(mission, "goal_kinds:\n",
         "goal_kinds:\n"
         "  balance:\n"
         "    objects: [{name: \"image-{id}\", type: image}]\n"
         "    goal: [\"(= (even) (odd))\"]\n");
    const fs::path domain = folder / "mission/domain.pddl";
    edit(domain, "(:functions (battery)", "(:functions (even) (odd) (battery)");
    for (const std::string counter : {"even", "odd"})
      edit(domain, "  (:durative-action drive",
           "  (:durative-action count-" + counter +
               " :parameters (?i - image) :duration (= ?duration 1)\n"
               "    :condition (at start (camera-idle)) :effect (at end (increase (" +
               counter +
               ") 2)))\n\n"
               "  (:durative-action drive");
    std::ofstream(folder / "mission/scenarios/one.yaml")
        << "description: A sample, and what nobody can plan.\nduration_s: 3600\n"
           "start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}\n"
           "science: {enabled: false}\nstimuli:\n"
           "  - {at_s: 5, goal: {issuer: ground, id: near, kind: pick_sample, importance: hard, "
           "arguments: {x: 42, y: 41}}}\n"
           "  - {at_s: 5, goal: {issuer: ground, id: never, kind: balance, importance: hard}}\n"
           "  - {at_s: 5, goal: {issuer: ground, id: nice, kind: balance, importance: optional, utility: "
           "1}}\n";
  }
  ~PlannerTimeout() override { fs::remove_all(folder); }

  std::vector<std::string> events() const { return journaled_events(folder / "run/journal.sqlite"); }
  nlohmann::json call(int number) const {
    return nlohmann::json::parse(text_of(folder / "run/planner_calls" / (std::to_string(number) + ".json")),
                                 nullptr, false);
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_planner_timeout_" + std::to_string(::getpid()));
};

// At this speed a second of the wall is half a minute of the mission, and the executive takes a call for lost after
// two minutes. Three searches are stopped under way: after the first one the optional goal leaves, after the second
// one the reserves may be used, after the third one the newest hard goal fails, each with the reason. The sample is
// then planned and picked, and the mission ends by itself.
TEST_P(PlannerTimeout, OfASearchUnderWayCostsGoalsWithTheirReasonAndNothingElse) {
  const Ended ended =
      run("timeout 100 roci-launch " + (folder / "mission").string() + " --scenario one --dds " + GetParam() +
          " --clock live --speed 30 --headless --json --run-folder " + (folder / "run").string());
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "partial") << ended.output;
  EXPECT_EQ(summary["goals"].value("open", -1), 0) << ended.output;
  EXPECT_EQ(summary["goals"].value("achieved", -1), 1) << ended.output;
  EXPECT_LT(summary.value("sim_s", 1e9), 1800) << ended.output;
  for (const int stopped : {1, 2, 3}) {
    EXPECT_EQ(call(stopped).value("verdict", ""), "timeout") << call(stopped);
    EXPECT_GT(call(stopped).value("evaluated", 0), 0) << call(stopped);
  }
  EXPECT_EQ(call(4).value("verdict", ""), "solved") << call(4);
  EXPECT_THAT(events(), Contains(AllOf(HasSubstr("goal.dropped"), HasSubstr("nice"),
                                       HasSubstr("within the planner's budget of 1 s"))));
  EXPECT_THAT(events(), Contains(AllOf(HasSubstr("goal.failed"), HasSubstr("never"),
                                       HasSubstr("within the planner's budget of 1 s"))));
  EXPECT_THAT(events(), Contains(HasSubstr("goal ground/near achieved")));
}

INSTANTIATE_TEST_SUITE_P(Transports, PlannerTimeout, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
