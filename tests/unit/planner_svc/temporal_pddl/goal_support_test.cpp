// Which goals each activity serves, and which block where there is no plan: by name, not by text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {

using call::NamedGoal;
using engine::NoFunctions;

namespace {

using temporal::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Model, testing::model;

// A rover that drives, takes images with a camera that is idle again afterwards, sends them, and carries
// samples.
const std::string kRover = R"(
  (:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals)
  (:types place image sample)
  (:predicates (at ?p - place) (idle) (have ?i - image) (sent ?i - image) (shows ?i - image ?p - place)
               (lies ?s - sample ?p - place) (empty) (held ?s - sample) (window) (never))
  (:functions (energy))
  (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration 10)
    :condition (and (at start (at ?a)) (over all (idle)) (at start (>= (energy) 10)))
    :effect (and (at start (not (at ?a))) (at end (at ?b)) (at start (decrease (energy) 10))))
  (:durative-action image :parameters (?i - image ?p - place) :duration (= ?duration 5)
    :condition (and (at start (shows ?i ?p)) (over all (at ?p)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (have ?i))))
  (:durative-action send :parameters (?i - image) :duration (= ?duration 5)
    :condition (and (at start (have ?i)) (over all (window)))
    :effect (at end (sent ?i)))
  (:durative-action pick :parameters (?s - sample ?p - place) :duration (= ?duration 5)
    :condition (and (over all (at ?p)) (at start (lies ?s ?p)) (at start (empty)))
    :effect (and (at start (not (empty))) (at end (not (lies ?s ?p))) (at end (held ?s))))
  (:durative-action drop :parameters (?s - sample ?p - place) :duration (= ?duration 5)
    :condition (and (over all (at ?p)) (at start (held ?s)))
    :effect (and (at end (not (held ?s))) (at end (lies ?s ?p)) (at end (empty))))
  (:durative-action charge :parameters () :duration (= ?duration 50)
    :condition (over all (idle))
    :effect (at end (increase (energy) 20))))";

std::string problem_of(const std::string& goal, double energy = 100, const std::string& more = "(window)") {
  return "(:objects h a b - place i j - image s - sample) (:init (at h) (idle) (empty) (shows i a) (shows j "
         "b)"
         " (lies s a) (= (energy) " +
         std::to_string(energy) + ") " + more + ") (:goal (and " + goal + "))";
}

Result plan_of(const Model& made, const std::vector<NamedGoal>& goals) {
  NoFunctions functions;
  return plan(made.domain, made.problem, functions, {}, {}, {}, {}, goals);
}

// "drive h a" → names of the goals that it serves.
std::map<std::string, std::set<std::string>> served(const Result& result,
                                                    const std::vector<NamedGoal>& goals) {
  std::map<std::string, std::set<std::string>> out;
  if (!result.plan) {
    ADD_FAILURE() << result.reason;
    return out;
  }
  for (const extraction::Activity& activity : result.plan->activities) {
    std::string text = activity.name;
    for (const std::string& object : activity.arguments) text += " " + object;
    auto& names = out[text];
    for (const std::size_t goal : activity.goals_served) names.insert(goals[goal].name);
  }
  return out;
}

using Names = std::set<std::string>;

TEST(GoalsServed, ADriveServesWhatIsDoneWhereItLeads) {
  const std::vector<NamedGoal> goals{{"i", {"(sent i)"}}, {"j", {"(sent j)"}}};
  const auto made = model(kRover, problem_of("(sent i) (sent j)"));
  auto found = served(plan_of(made, goals), goals);
  EXPECT_EQ(found["image i a"], Names{"i"});
  EXPECT_EQ(found["send i"], Names{"i"});
  EXPECT_EQ(found["image j b"], Names{"j"});
  const bool a_first = found.contains("drive h a");
  EXPECT_EQ(found[a_first ? "drive h a" : "drive h b"], Names{a_first ? "i" : "j"})
      << "not the other one, for which the rover leaves again";
  EXPECT_EQ(found[a_first ? "drive a b" : "drive b a"], Names{a_first ? "j" : "i"});
}

TEST(GoalsServed, WhatIsUsedUpByTheNextActionAloneServesItsGoal) {
  const std::vector<NamedGoal> goals{{"moved", {"(lies s b)"}}};
  const auto made = model(kRover, problem_of("(lies s b)"));
  auto found = served(plan_of(made, goals), goals);
  EXPECT_EQ(found.size(), 4U);
  for (const std::string action : {"drive h a", "pick s a", "drive a b", "drop s b"})
    EXPECT_EQ(found[action], Names{"moved"}) << action;
}

TEST(GoalsServed, AGoalThatIsAchievedOnTheWayIsServedToo) {
  const std::vector<NamedGoal> goals{{"moved", {"(lies s b)"}}, {"image", {"(have i)"}}};
  const auto made = model(kRover, problem_of("(lies s b) (have i)"));
  auto found = served(plan_of(made, goals), goals);
  EXPECT_EQ(found["drive h a"], (Names{"image", "moved"}));
  EXPECT_EQ(found["image i a"], Names{"image"}) << "the camera that is idle again is no help to the drive";
  EXPECT_EQ(found["drive a b"], Names{"moved"});
}

TEST(GoalsServed, WhatFillsTheBatteryServesThoseThatDrawOnIt) {
  const std::vector<NamedGoal> goals{{"i", {"(have i)"}}};
  const auto made = model(kRover, problem_of("(have i)", 5));
  auto found = served(plan_of(made, goals), goals);
  EXPECT_EQ(found["charge"], Names{"i"});
}

TEST(GoalsServed, WithoutNamedGoalsNothingIsSaid) {
  const auto made = model(kRover, problem_of("(have i)"));
  for (const auto& [action, names] : served(plan_of(made, {}), {})) EXPECT_THAT(names, IsEmpty()) << action;
}

std::vector<std::string> blocked(const Result& result) {
  EXPECT_EQ(result.verdict, Verdict::unsolvable) << result.reason;
  std::vector<std::string> facts;
  for (const call::BlockedFact& one : result.blocked) facts.push_back(one.fact);
  return facts;
}

TEST(BlockedFacts, WhatNothingBringsAboutIsNamed) {
  EXPECT_THAT(blocked(plan_of(model(kRover, problem_of("(sent i) (never)")), {})), ElementsAre("(never)"));
  EXPECT_THAT(blocked(plan_of(model(kRover, problem_of("(sent i) (have j)", 100, "")), {})),
              ElementsAre("(sent i)"))
      << "there is no window";
}

TEST(BlockedFacts, WhatTimeForbidsIsNamed) {
  const Result result =
      plan_of(model(kRover, problem_of("(sent i) (have j)", 100, "(window) (at 12 (not (window)))")), {});
  EXPECT_THAT(blocked(result), ElementsAre("(sent i)"));
  EXPECT_THAT(result.blocked.at(0).reason, HasSubstr("too late"));
}

TEST(BlockedFacts, GoalsThatDoNotFitTogetherAreNotBlamedOneByOne) {
  const auto made = model(R"((:requirements :strips) (:predicates (coin) (tea) (coffee))
    (:action buy-tea :parameters () :precondition (coin) :effect (and (not (coin)) (tea)))
    (:action buy-coffee :parameters () :precondition (coin) :effect (and (not (coin)) (coffee))))",
                          "(:init (coin)) (:goal (and (tea) (coffee)))");
  EXPECT_THAT(blocked(plan_of(made, {})), IsEmpty());
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
