// The world differs from the planner's model, and the model follows the map and the arm: with every real
// service.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "tests/scenario/mission_in_process.hpp"

namespace roci::scenario {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// One optional photo, 30 m away, in a window; the ground is more slippery than the path planner takes it for.
std::map<std::string, std::string> photo_in_window(double opens_s, double closes_s) {
  std::ostringstream text;
  text << "duration_s: 9000\nstart: {x: 40, y: 40, arm: stow, battery: 900000}\nworld: {slip: 0.12}\n"
       << "science: {enabled: false}\nstimuli:\n"
       << "  - {at_s: 10, goal: {id: spot, kind: photo, importance: optional, opens_s: " << opens_s
       << ", closes_s: " << closes_s << ", arguments: {x: 70, y: 45}}}\n";
  return {{"scenarios/nominal.yaml", text.str()}};
}

// What became of the first plan's image.
struct Start {
  double arrived_s = 0;  // end of the drive before it
  std::optional<double> started_s;
  double lower_s = 0, upper_s = 0;  // as planned
  bool late = false;                // the plan broke because the latest start had passed
  std::uint32_t replans = 0;
};

Start fly_to_window(double opens_s, double closes_s, std::uint64_t seed) {
  MissionInProcess mission(photo_in_window(opens_s, closes_s), seed);
  mission.run();
  Start out;
  for (const v1::StepStatus& step : mission.steps()) {
    if (step.plan_version() != 1) continue;
    if (step.name() == "drive" && step.state() == v1::ACTIVITY_SUCCEEDED)
      out.arrived_s = step.ended_us() / 1e6;
    if (step.name() != "take-image") continue;
    if (out.upper_s == 0) {
      out.lower_s = step.earliest_start_us() / 1e6;
      out.upper_s = step.latest_start_us() / 1e6;
    }
    if (step.started_us() >= 0) out.started_s = step.started_us() / 1e6;
  }
  const auto& events = mission.events();
  out.late = std::any_of(events.begin(), events.end(), [](const std::string& event) {
    return event.starts_with("plan.broken") && event.find("latest start") != std::string::npos;
  });
  out.replans = mission.mission().replans();
  return out;
}

// R49. The window is laid through the arrivals of the same seeds without one, so that some come before it
// opens, some while an image may still begin, some too late.
TEST(Reality, EveryBranchOfTheStartRuleOccursOverSeeds) {
  constexpr std::uint64_t kSeeds = 12;
  std::vector<double> arrivals;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    arrivals.push_back(fly_to_window(0, 8000, seed).arrived_s);
  EXPECT_EQ(std::set<double>(arrivals.begin(), arrivals.end()).size(), kSeeds) << "slip varies with the seed";
  std::vector<double> sorted = arrivals;
  std::ranges::sort(sorted);
  const double opens = (sorted[3] + sorted[4]) / 2;
  const double last_start = (sorted[7] + sorted[8]) / 2;
  int early = 0, inside = 0, late = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const double arrival = arrivals[seed - 1];
    const Start start = fly_to_window(opens, last_start + 40, seed);
    EXPECT_NEAR(start.upper_s, last_start, 0.01);
    if (arrival <= opens) {
      ++early;
      EXPECT_NEAR(start.started_s.value(), opens, 0.01);
    } else if (arrival <= last_start) {
      ++inside;
      EXPECT_NEAR(start.started_s.value(), arrival, 0.01);
    } else {
      ++late;
      EXPECT_EQ(start.started_s, std::nullopt);
    }
    EXPECT_EQ(start.late, arrival > last_start);
    EXPECT_EQ(start.replans, arrival > last_start ? 1U : 0U)
        << "R50: a delay inside the window never replans";
  }
  EXPECT_EQ(early, 4);
  EXPECT_EQ(inside, 4);
  EXPECT_EQ(late, 4);
}

// Ground truth and estimate come from models of their own: they agree roughly, never exactly.
TEST(Reality, DrivesTakeLongerOrShorterThanEstimatedByPlaceAndSeed) {
  std::set<std::int64_t> ratios;
  std::size_t drives = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    MissionInProcess mission({}, seed);
    mission.run();
    std::map<std::string, double> planned;
    for (const v1::PlanActivity& activity : mission.plans().front().activities())
      planned[activity.id()] = static_cast<double>(activity.duration_lower_us());
    for (const v1::StepStatus& step : mission.steps()) {
      if (step.name() != "drive" || step.state() != v1::ACTIVITY_SUCCEEDED) continue;
      const double ratio =
          static_cast<double>(step.ended_us() - step.started_us()) / planned.at(step.activity());
      EXPECT_GT(ratio, 0.7);
      EXPECT_LT(ratio, 1.5);
      ratios.insert(static_cast<std::int64_t>(ratio * 1e6));
      ++drives;
    }
    EXPECT_EQ(mission.mission().replans(), 0U) << "nothing has to be replanned for that";
  }
  EXPECT_GE(drives, 6U);
  EXPECT_EQ(ratios.size(), drives) << "no two alike";
  EXPECT_FALSE(ratios.contains(1'000'000));
}

double value_of(const v1::Plan& plan, const std::string& function,
                const std::vector<std::string>& arguments) {
  for (const v1::FunctionValueUse& use : plan.function_values())
    if (use.function() == function && use.arguments() == arguments) return use.number();
  ADD_FAILURE() << "the plan does not use " << function;
  return 0;
}

// How long the plan's activity of this name takes whose command has these arguments, in s; of several alike the first.
double duration_of(const v1::Plan& plan, const std::string& name,
                   const std::map<std::string, std::string>& arguments) {
  std::string all;
  for (const v1::PlanActivity& activity : plan.activities()) {
    std::map<std::string, std::string> own;
    for (const v1::PlanCommand& command : activity.commands())
      for (const v1::Property& argument : command.arguments())
        if (arguments.contains(argument.name())) own[argument.name()] = argument.value();
    if (activity.name() == name && own == arguments)
      return static_cast<double>(activity.duration_lower_us()) / 1e6;
    all += " " + activity.name();
    for (const auto& [argument, value] : own) all += " " + argument + "=" + value;
  }
  ADD_FAILURE() << "the plan has no such " << name << ":" << all;
  return 0;
}

v1::Plan first_plan(const std::map<std::string, std::string>& changed) {
  MissionInProcess mission(changed);
  mission.send(std::chrono::seconds(10), goal("near", "photo", {{"x", "70"}, {"y", "45"}}));
  mission.send(std::chrono::seconds(10), goal("grain", "pick_sample", {{"x", "48"}, {"y", "40"}}));
  mission.run();
  if (mission.plans().empty()) {
    ADD_FAILURE() << "no plan";
    return {};
  }
  return mission.plans().front();
}

const std::string kOneScenario =
    "duration_s: 3000\nstart: {x: 40, y: 40, arm: stow, battery: 900000}\nscience: {enabled: false}\n";

TEST(Reality, AnObstacleChangesTheOfferedValuesAndThePlan) {
  const v1::Plan open = first_plan({{"scenarios/nominal.yaml", kOneScenario}});
  const v1::Plan walled = first_plan(
      {{"scenarios/nominal.yaml", kOneScenario},
       {"mission.yaml", planetary_file("mission.yaml", "rover:\n  {radius_m",
                                       "rover:\n  {keep_out: [{x: 59, y: 43, radius_m: 6}], radius_m")}});
  for (const char* function : {"traverse_time", "traverse_energy"}) {
    const std::vector<std::string> way{"place-grain", "place-near"};
    EXPECT_GT(value_of(walled, function, way), 1.02 * value_of(open, function, way)) << function;
  }
  // The plan takes the way around, and for it the time that was offered.
  const std::vector<std::string> way{"place-grain", "place-near"};
  for (const v1::Plan* plan : {&open, &walled})
    EXPECT_NEAR(duration_of(*plan, "drive", {{"to", way[1]}}), value_of(*plan, "traverse_time", way), 0.01);
  EXPECT_GT(duration_of(walled, "drive", {{"to", way[1]}}),
            1.02 * duration_of(open, "drive", {{"to", way[1]}}));
}

TEST(Reality, ALowerJointLimitChangesTheOfferedValuesAndThePlan) {
  const std::vector<std::string> motion{"stow", "sampling"};
  const v1::Plan as_is = first_plan({{"scenarios/nominal.yaml", kOneScenario}});
  const v1::Plan slow = first_plan(
      {{"scenarios/nominal.yaml", kOneScenario},
       {"arm/arm.urdf", planetary_file("arm/arm.urdf", "velocity=\"0.25\"", "velocity=\"0.10\"")}});
  EXPECT_GT(value_of(slow, "arm_move_time", motion), 1.2 * value_of(as_is, "arm_move_time", motion));
  for (const v1::Plan* plan : {&as_is, &slow})
    EXPECT_NEAR(duration_of(*plan, "move-arm", {{"from", motion[0]}, {"to", motion[1]}}),
                value_of(*plan, "arm_move_time", motion), 0.01);
  EXPECT_GT(duration_of(slow, "move-arm", {{"from", motion[0]}, {"to", motion[1]}}),
            1.2 * duration_of(as_is, "move-arm", {{"from", motion[0]}, {"to", motion[1]}}));
}

// R8, R42: over a mission with replans and dropped goals each problem is another one, the domain never is.
TEST(Reality, TheDomainIsTheSameInEveryCall) {
  MissionInProcess mission({{"scenarios/nominal.yaml", planetary_file("scenarios/blocked_window.yaml")}});
  mission.run();
  ASSERT_GE(mission.calls().size(), 3U);
  std::set<std::string> problems;
  for (const v1::PlanRequest& call : mission.calls()) {
    EXPECT_EQ(call.model(), planetary_file("domain.pddl"));
    problems.insert(call.problem_text());
  }
  EXPECT_EQ(problems.size(), mission.calls().size());
}

// R146: the rover looks for a way around by itself; that shows as the drive's state, and no new plan follows.
TEST(Reality, AWayAroundARockIsTheOwnersRepairAndVisible) {
  const std::map<std::string, std::string> one_rock{
      {"scenarios/nominal.yaml",
       "duration_s: 9000\nstart: {x: 40, y: 40, arm: stow, battery: 900000}\n"
       "world: {rocks: [{x: 55, y: 42, radius: 1}]}\nscience: {enabled: false}\nstimuli:\n"
       "  - {at_s: 10, goal: {id: spot, kind: photo, arguments: {x: 70, y: 45}}}\n"}};
  MissionInProcess mission(one_rock);
  mission.run();
  std::vector<std::string> told;
  for (const v1::StepStatus& step : mission.steps())
    if (step.name() == "drive" && step.state() == v1::ACTIVITY_RUNNING && !step.cause().empty())
      told.push_back(step.cause());
  EXPECT_THAT(told, ElementsAre(AllOf(HasSubstr("its owner repairs [repairing]"), HasSubstr("rock-1"))));
  EXPECT_EQ(mission.mission().replans(), 0U);
  EXPECT_EQ(mission.goal("spot").states.back(), v1::GOAL_ACHIEVED);
}

// The shoulder no longer reaches the ground: no plan has the sample, and the reason names it.
TEST(Reality, AJointThatReachesNoGroundCostsTheGoalThatNeedsIt) {
  MissionInProcess mission(
      {{"scenarios/nominal.yaml", kOneScenario},
       {"arm/arm.urdf", planetary_file("arm/arm.urdf", "upper=\"0.8\"", "upper=\"-2.0\"")}});
  mission.send(std::chrono::seconds(10), goal("near", "photo", {{"x", "70"}, {"y", "45"}}));
  mission.send(std::chrono::seconds(10), goal("grain", "pick_sample", {{"x", "48"}, {"y", "40"}}));
  mission.run();
  EXPECT_EQ(mission.goal("grain").states.back(), v1::GOAL_FAILED);
  EXPECT_THAT(mission.goal("grain").reason, HasSubstr("picked sample-grain"));
  EXPECT_EQ(mission.goal("near").states.back(), v1::GOAL_ACHIEVED) << mission.goal("near").reason;
}

}  // namespace
}  // namespace roci::scenario
