// The engine behind the seam of planner_svc: what the request names comes back by name, and the checker sees
// each fault of a plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/engine/checked_answer.hpp"
#include "planner_svc/engines.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using engine::Answer, engine::BlockingGoal, engine::Request;
using temporal::FlexiblePlan, temporal::Verdict;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kTrips = R"((define (domain trips)
  (:requirements :typing :durative-actions :numeric-fluents) (:types place)
  (:predicates (at ?p - place) (seen ?p - place) (flown)) (:functions (fuel))
  (:durative-action go :parameters (?a ?b - place) :duration (= ?duration 10)
    :condition (and (at start (at ?a)) (at start (>= (fuel) 3)))
    :effect (and (at start (not (at ?a))) (at start (decrease (fuel) 3)) (at end (at ?b))))
  (:durative-action look :parameters (?p - place) :duration (= ?duration 5)
    :condition (over all (at ?p)) :effect (at end (seen ?p)))))";

engine::Goal goal_of(const std::string& id, const std::string& fact) {
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = id;
  goal.achieved = temporal::compare(fact, temporal::ConditionOp::eq, true);
  return goal;
}

Request request_for(const std::vector<engine::Goal>& goals) {
  Request request;
  request.engine = "temporal_pddl";
  request.model = kTrips;
  request.problem_text =
      "(define (problem p) (:domain trips) (:objects a b c - place) (:init (at a) (= (fuel) 9)) (:goal (and";
  for (const engine::Goal& goal : goals) request.problem_text += " " + goal.achieved.nodes.front().timeline;
  request.problem_text += ")))";
  request.goals = goals;
  return request;
}

Answer answer_to(const Request& request) {
  engine::NoFunctions functions;
  return engine::answer_checked(engines(), request, {}, functions);
}

TEST(PddlEngine, TheRequestSaysWhatBetterPlansMayCost) {
  Request request = request_for({goal_of("one", "(seen b)"), goal_of("two", "(seen c)")});
  const auto evaluated = [&](std::uint64_t improvement) {
    request.improvement = improvement;
    const Answer answer = answer_to(request);
    EXPECT_TRUE(answer.plan) << answer.reason;
    return answer.statistics.evaluated;
  };
  const auto none = evaluated(0), few = evaluated(3), many = evaluated(engine::kImprovement);
  EXPECT_LT(none, few);
  EXPECT_LE(few, none + 3);
  EXPECT_LT(few, many);
}

TEST(PddlEngine, ActivitiesServeGoalsByIssuerAndId) {
  const Answer answer = answer_to(request_for({goal_of("one", "(seen b)"), goal_of("two", "(seen c)")}));
  ASSERT_TRUE(answer.plan) << answer.reason;
  ASSERT_EQ(answer.plan->activities.size(), 4U);
  const auto& activities = answer.plan->activities;
  const std::string first = activities[0].arguments[1].value == "b" ? "ground/one" : "ground/two";
  EXPECT_THAT(activities[0].goals_served, ElementsAre(first));
  EXPECT_THAT(activities[1].goals_served, ElementsAre(first));
  EXPECT_THAT(activities[3].goals_served, ElementsAre(first == "ground/one" ? "ground/two" : "ground/one"));
}

TEST(PddlEngine, ConditionsAndEffectsAreStructures) {
  const Answer answer = answer_to(request_for({goal_of("one", "(at b)")}));
  ASSERT_TRUE(answer.plan) << answer.reason;
  const temporal::PlanActivity& go = answer.plan->activities.at(0);
  EXPECT_EQ(go.pre, temporal::all_of({temporal::compare("(at a)", temporal::ConditionOp::eq, true),
                                      temporal::compare("(fuel)", temporal::ConditionOp::ge, 3.0)}));
  EXPECT_THAT(
      go.impacts,
      ElementsAre(
          temporal::Impact{"(at a)", temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, false},
          temporal::Impact{"(fuel)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -3.0},
          temporal::Impact{"(at b)", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, true}));
}

TEST(PddlEngine, WhatIsOutOfReachIsNamedByIssuerAndId) {
  const Answer answer = answer_to(request_for({goal_of("one", "(seen b)"), goal_of("fly", "(flown)")}));
  EXPECT_EQ(answer.verdict, Verdict::unsolvable);
  EXPECT_THAT(answer.blocking, ElementsAre(BlockingGoal{"ground", "fly", "(flown)", ""}));
}

// A goal that no timeline can say is named by its text (problem_writer of exec_svc).
TEST(PddlEngine, AFormulaOutOfReachIsNamedAndNoOtherGoal) {
  const std::string formula = "(exists (?p - place) (and (at ?p) (flown)))";
  const Answer answer = answer_to(request_for({goal_of("one", "(seen b)"), goal_of("fly", formula)}));
  EXPECT_EQ(answer.verdict, Verdict::unsolvable);
  EXPECT_THAT(answer.blocking, ElementsAre(BlockingGoal{"ground", "fly", formula, ""}));
}

TEST(PddlEngine, ABadProblemIsToldAndKept) {
  Request request = request_for({});
  request.problem_text = "(define (problem";
  const Answer answer = answer_to(request);
  EXPECT_EQ(answer.verdict, Verdict::invalid_input);
  EXPECT_THAT(answer.reason, HasSubstr("problem:1:"));
  ASSERT_FALSE(answer.record.empty());
  EXPECT_EQ(answer.record[0].text, request.problem_text);
}

TEST(PddlChecker, RefusesPlansWithAFault) {
  const Request request = request_for({goal_of("one", "(seen b)"), goal_of("two", "(seen c)")});
  const FlexiblePlan plan = answer_to(request).plan.value_or(FlexiblePlan{});
  ASSERT_EQ(plan.activities.size(), 4U);
  const auto checker = engines().at("temporal_pddl").make_checker();
  const auto faults = [&](const FlexiblePlan& checked) {
    return checker->faults({request, {}, checked, nullptr, nullptr});
  };
  EXPECT_THAT(faults(plan), IsEmpty());
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    FlexiblePlan other = plan;
    other.activities[i].name = other.activities[i].name == "go" ? "look" : "go";
    EXPECT_FALSE(faults(other).empty()) << "another action at " << i;
    other = plan;
    other.activities[i].arguments[0].value = "c";
    other.activities[i].arguments.back().value = "a";
    EXPECT_FALSE(faults(other).empty()) << "other objects at " << i;
    other = plan;
    other.activities[i].duration_lower = other.activities[i].duration_upper = temporal::seconds(7);
    EXPECT_FALSE(faults(other).empty()) << "another duration at " << i;
  }
  FlexiblePlan unordered = plan;
  unordered.constraints.clear();
  EXPECT_FALSE(faults(unordered).empty());
  FlexiblePlan generous = plan;
  generous.activities[0].goals_served.push_back("ground/three");
  EXPECT_THAT(faults(generous), Contains(AllOf(HasSubstr("ground/three"), HasSubstr("not asked for"))));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
