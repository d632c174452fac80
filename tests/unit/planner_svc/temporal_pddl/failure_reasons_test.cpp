// Why there is no plan: each verdict names what is in the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using temporal::Verdict;
using ::testing::HasSubstr;

std::string why(const std::string& domain, const std::string& problem) {
  const Result result = testing::solved(testing::model(domain, problem));
  EXPECT_EQ(result.verdict, Verdict::unsolvable) << result.reason;
  return result.reason;
}

constexpr const char* kDriller = R"((:requirements :durative-actions :numeric-fluents)
    (:predicates (sample) (charged) (delivered)) (:functions (battery) (heat))
    (:durative-action charge :parameters () :duration (= ?duration 5)
      :condition (at start (not (charged)))
      :effect (and (at start (charged)) (at end (increase (battery) 8))))
    (:durative-action drill :parameters () :duration (= ?duration 3)
      :condition (and (at start (>= (battery) 30)) (over all (<= (heat) 9)))
      :effect (and (at start (decrease (battery) 12)) (at end (sample))))
    (:durative-action deliver :parameters () :duration (= ?duration 3)
      :condition (at start (sample)) :effect (at end (delivered))))";

TEST(FailureReasons, AGoalThatNothingReaches) {
  EXPECT_THAT(why("(:predicates (p) (g) (h)) (:action a :parameters () :precondition (p) :effect (g))"
                  "(:action b :parameters () :precondition () :effect (h))",
                  "(:init) (:goal (and (h) (g)))"),
              ::testing::EndsWith("numbers did not count: (g)"));
}

TEST(FailureReasons, ABoundOfAnActionOnTheWay) {
  EXPECT_THAT(why(kDriller, "(:init (= (battery) 20) (= (heat) 0)) (:goal (delivered))"),
              HasSubstr("never reached: (delivered); (drill) needs (battery) >= 30: never more than 28"));
}

TEST(FailureReasons, ABoundOfTheGoal) {
  EXPECT_THAT(why(kDriller, "(:init (= (battery) 40) (= (heat) 0)) (:goal (and (sample) (>= (battery) 50)))"),
              HasSubstr("the goal needs (battery) >= 50: never more than 48"));
}

TEST(FailureReasons, AnUpperBoundAndAnEquality) {
  constexpr const char* domain = R"((:requirements :numeric-fluents) (:predicates (p) (g)) (:functions (x))
    (:action cool :parameters () :precondition (p) :effect (and (not (p)) (decrease (x) 2)))
    (:action a :parameters () :precondition (< (x) 5) :effect (g)))";
  EXPECT_THAT(why(domain, "(:init (p) (= (x) 9)) (:goal (g))"),
              HasSubstr("(a) needs (x) < 5: never less than 7"));
  EXPECT_THAT(why(domain, "(:init (p) (= (x) 9)) (:goal (= (x) 8))"),
              HasSubstr("the goal needs (x) = 8, which it never is"));
}

TEST(FailureReasons, AWindowThatIsShorterThanTheAction) {
  EXPECT_THAT(
      why(R"((:requirements :durative-actions :timed-initial-literals)
    (:constants a b) (:predicates (lit ?p) (seen ?p) (reported))
    (:durative-action see :parameters (?p) :duration (= ?duration 12)
      :condition (over all (lit ?p)) :effect (at end (seen ?p)))
    (:action report :parameters () :precondition (and (seen a) (seen b)) :effect (reported)))",
          R"((:init (lit b) (at 1 (lit a)) (at 5 (not (lit a))) (at 20 (lit a)) (at 29.5 (not (lit a))))
    (:goal (reported)))"),
      HasSubstr("(see a) takes 12.000 s, its longest window is 9.500 s: 2.500 s too short"));
}

TEST(FailureReasons, AWindowThatIsTooShortWithItsSeparations) {
  EXPECT_THAT(
      why(R"((:requirements :durative-actions :timed-initial-literals) (:predicates (lit) (seen))
    (:durative-action see :parameters () :duration (= ?duration 3)
      :condition (and (at start (lit)) (over all (lit)) (at end (lit))) :effect (at end (seen))))",
          "(:init (at 1 (lit)) (at 4 (not (lit)))) (:goal (seen))"),
      ::testing::AllOf(HasSubstr("all conditions of (see) at once, those on its duration included, while "
                                 "timed literals let it run"),
                       ::testing::Not(HasSubstr("never true"))));
}

TEST(FailureReasons, ADurationThatHasNoValue) {
  EXPECT_THAT(why(R"((:requirements :durative-actions :numeric-fluents) (:predicates (g)) (:functions (t))
    (:durative-action a :parameters () :duration (= ?duration (t)) :effect (at end (g))))",
                  "(:init (= (t) -3)) (:goal (g))"),
              HasSubstr("all conditions of (a) at once, those on its duration included;"));
}

TEST(FailureReasons, AGoalThatOnlyATimedLiteralBringsAboutAfterAllActions) {
  EXPECT_THAT(
      why(R"((:requirements :timed-initial-literals) (:predicates (p) (g) (night))
    (:action a :parameters () :precondition (p) :effect (and (not (p)) (g))))",
          "(:init (p) (at 5 (not (p))) (at 20 (night))) (:goal (and (g) (night)))"),
      HasSubstr("what a timed literal brings about for a goal counts only if an action starts or ends"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
