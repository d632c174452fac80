// Actions that can never run, and facts that are never true: the verdict names them and says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using temporal::Verdict;
using ::testing::StartsWith;

std::string why(const std::string& domain, const std::string& problem) {
  const Result result =
      testing::solved(testing::model("(:requirements :durative-actions :typing)" + domain, problem));
  EXPECT_EQ(result.verdict, Verdict::unsolvable) << result.reason;
  return result.reason;
}

// `between` stands in the effect beside what the end adds.
std::string blink(const std::string& duration, const std::string& between) {
  return "(:predicates (p) (q) (seen) (g)) (:durative-action blink :parameters () :duration (= ?duration " +
         duration + ") :condition (and (at start (p)) (over all (p))) :effect (and " + between +
         " (at end (seen)))) (:action report :parameters () :precondition (seen) :effect (g))";
}

constexpr const char* kGoal = "(:init (p)) (:goal (g))";

TEST(ImpossibleActions, ADurationOfZeroIsTakenWhereStartAndEndHaveNothingInCommon) {
  const auto model =
      testing::model("(:requirements :durative-actions)" + blink("0", "(at start (q))"), kGoal);
  testing::expect_valid(model, testing::solved(model));
}

TEST(ImpossibleActions, AnOverAllCountsForADurationOfZeroToo) {
  EXPECT_THAT(why(blink("0", "(at start (not (p)))"), kGoal),
              StartsWith("(blink) can never run: its start makes its own condition over all false, (p)"));
}

TEST(ImpossibleActions, ADurationOfLessThanEpsilonIsNamedWithEpsilon) {
  for (const char* duration : {"0", "0.0005"}) {
    EXPECT_THAT(
        why(blink(duration, "(at start (q)) (at end (not (q)))"), kGoal),
        StartsWith(std::string("(blink) can never run: it takes at most ") +
                   (duration == std::string("0") ? "0.000 s" : "0.000500 s") +
                   ", but its start and its end change or read the same, so they are at least ε = 0.001 s "
                   "apart"));
  }
}

TEST(ImpossibleActions, AnActionWhoseStartBreaksItsOwnOverAllIsNamed) {
  EXPECT_THAT(why(blink("3", "(at start (not (p)))"), kGoal),
              StartsWith("(blink) can never run: its start makes its own condition over all false, (p)"));
}

TEST(ImpossibleActions, AnotherWayToTheGoalIsTaken) {
  const auto model = testing::model(
      "(:requirements :durative-actions) (:predicates (p) (g)) (:durative-action never :parameters () "
      ":duration "
      "(= ?duration 1) :condition (over all (p)) :effect (and (at start (not (p))) (at end (g)))) "
      "(:durative-action plain :parameters () :duration (= ?duration 9) :condition (over all (p)) :effect "
      "(at end "
      "(g)))",
      "(:init (p)) (:goal (g))");
  testing::expect_valid(model, testing::solved(model));
}

constexpr const char* kPost =
    R"((:types robot site) (:predicates (at ?r - robot ?s - site) (charged ?r - robot)
    (link ?a ?b - site) (sample ?s - site) (sent ?s - site))
    (:durative-action drive :parameters (?r - robot ?a ?b - site) :duration (= ?duration 3)
      :condition (and (at start (at ?r ?a)) (over all (link ?a ?b)))
      :effect (and (at start (not (at ?r ?a))) (at end (at ?r ?b))))
    (:durative-action send :parameters (?r - robot ?s - site) :duration (= ?duration 2)
      :condition (and (at start (at ?r ?s)) (at start (charged ?r)) (at start (sample ?s)))
      :effect (at end (sent ?s))))";

TEST(ImpossibleActions, AFactThatIsNeverTrueIsNamedWithTheActionThatWantsIt) {
  EXPECT_THAT(
      why(kPost, "(:objects r - robot a b - site) (:init (at r a) (link a b) (sample b)) (:goal (sent b))"),
      StartsWith("(send ? b) needs (charged ?), which is never true: it is not in :init, and no effect "
                 "adds it; no sequence of actions reaches"));
}

TEST(ImpossibleActions, AFactThatIsNeverTrueIsNamedWithTheGoalThatWantsIt) {
  EXPECT_THAT(
      why(kPost, "(:objects r - robot a b - site) (:init (at r a)) (:goal (and (at r a) (link a b)))"),
      StartsWith(
          "the goal needs (link a b), which is never true: it is not in :init, and no effect adds it"));
}

TEST(ImpossibleActions, AFactThatIsAlwaysTrueIsNamedWithTheGoalThatWantsItFalse) {
  EXPECT_THAT(
      why(kPost, "(:objects r - robot a b - site) (:init (at r a) (link a b)) (:goal (not (link a b)))"),
      StartsWith("the goal needs (not (link a b)), but it is in :init and no effect deletes it"));
}

TEST(ImpossibleActions, ConditionsThatNoObjectsMeetTogetherAreToldAsSuch) {
  EXPECT_THAT(
      why(kPost,
          "(:objects r s - robot a b - site) (:init (at r a) (charged s) (sample a)) (:goal (sent a))"),
      StartsWith("no choice of objects meets all conditions of (send ? a) at once"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
