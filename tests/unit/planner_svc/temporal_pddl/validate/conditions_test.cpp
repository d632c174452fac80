// Conditions at start, over all, at end and in goals; timed facts; what a plan must look like at all.
#include <gmock/gmock.h>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

using ::testing::HasSubstr;

// A match gives light for 5 s; mending takes 3 s, needs light over all and the fuse at its end.
const World kCellar = {
    "(:types fuse match) (:predicates (light) (unused ?m - match) (mended ?f - fuse) (whole ?f - fuse))"
    "(:durative-action strike :parameters (?m - match) :duration (= ?duration 5)"
    " :condition (at start (unused ?m))"
    " :effect (and (at start (not (unused ?m))) (at start (light)) (at end (not (light)))))"
    "(:durative-action mend :parameters (?f - fuse) :duration (= ?duration 3)"
    " :condition (and (over all (light)) (at end (whole ?f))) :effect (at end (mended ?f)))",
    "(:objects f - fuse m n - match) (:init (unused m) (unused n) (whole f)) (:goal (mended f))", ""};

TEST(Conditions, ConcurrencyThatIsNeededIsFound) {
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n0.001: (mend f) [3]"), "");
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n1.999: (mend f) [3]"), "");
}

TEST(Conditions, InvariantsHoldInTheOpenInterval) {
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n2: (mend f) [3]"), "") << "light goes at the very end";
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n0: (mend f) [3]"), "")
      << "light comes at the very start";
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n2.001: (mend f) [3]"), "invariant@5.000");
  EXPECT_EQ(check_kinds(kCellar, "1: (strike m) [5]\n0.999: (mend f) [3]"), "invariant@0.999");
  EXPECT_EQ(check_kinds(kCellar, "1: (mend f) [3]"), "invariant@1.000");
}

TEST(Conditions, AtStartAndAtEnd) {
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n1: (mend f) [3]\n6: (strike m) [5]"), "condition@6.000");
  World broken = kCellar;
  broken.problem = "(:objects f - fuse m n - match) (:init (unused m)) (:goal (mended f))";
  const Report report = check_plan(broken, "0: (strike m) [5]\n1: (mend f) [3]");
  EXPECT_EQ(kinds(report), "condition@4.000");
  EXPECT_EQ(report.violations[0].step, 1u);
  EXPECT_EQ(report.violations[0].action, "(mend f)");
  EXPECT_EQ(report.violations[0].condition, "(whole f)");
  EXPECT_THAT(report.violations[0].message, HasSubstr("condition at end (whole f) does not hold"));
}

TEST(Conditions, EveryConjunctOfTheGoalIsReported) {
  World world = kCellar;
  world.problem =
      "(:objects f - fuse m n - match) (:init (unused m)) (:goal (and (mended f) (unused m) (light)))";
  EXPECT_EQ(check_kinds(world, ""), "goal@0.000 goal@0.000");
  const Report report = check_plan(world, "");
  EXPECT_FALSE(report.violations[0].step);
  EXPECT_EQ(report.violations[0].condition, "(mended f)");
}

TEST(Conditions, TimedFactsOpenAndCloseWindows) {
  const World world = {
      "(:predicates (open) (sent)) (:functions (level))"
      "(:durative-action send :parameters () :duration (= ?duration 2) :condition (and (at start (open)) "
      "(over all (open)))"
      " :effect (at end (sent)))"
      "(:action press :precondition (>= (level) 4) :effect (sent))",
      "(:init (= (level) 0) (at 5 (open)) (at 9 (not (open))) (at 20 (open)) (at 6 (= (level) 4))) (:goal "
      "(sent))",
      ""};
  EXPECT_EQ(check_kinds(world, "5.001: (send) [2]"), "");
  EXPECT_EQ(check_kinds(world, "7: (send) [2]"), "") << "the window closes at the very end";
  EXPECT_EQ(check_kinds(world, "4: (send) [2]"), "condition@4.000 invariant@4.000");
  EXPECT_EQ(check_kinds(world, "7.001: (send) [2]"), "invariant@9.000");
  EXPECT_EQ(check_kinds(world, "5: (send) [2]"), "condition@5.000 interference@5.000")
      << "the fact comes at 5, too late";
  EXPECT_EQ(check_kinds(world, "20.001: (send) [2]"), "");
  EXPECT_EQ(check_kinds(world, "6.001: (press)"), "");
  EXPECT_EQ(check_kinds(world, "5.999: (press)"), "condition@5.999");
}

TEST(Conditions, TimedFactsAfterThePlanDoNotCount) {
  const World world = {"(:predicates (open)) (:action wait :effect ())",
                       "(:init (at 5 (open))) (:goal (open))", ""};
  EXPECT_EQ(check_kinds(world, "4: (wait)"), "goal@4.000");
  EXPECT_EQ(check_kinds(world, "5: (wait)"), "");
  EXPECT_EQ(check_kinds(world, ""), "goal@0.000");
}

TEST(Conditions, StepsMustBeActionsOfTheDomain) {
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n1: (mend f) [3]\n2: (jump) [1]"),
            "unknown action@2.000");
  EXPECT_EQ(check_kinds(kCellar, "1: (mend)"), "goal@0.000 wrong arguments@1.000") << "and is not executed";
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m) [5]\n1: (mend m) [3]"), "wrong arguments@1.000 goal@5.000");
  EXPECT_EQ(check_kinds(kCellar, "0: (strike x) [5]\n1: (mend f) [3]"),
            "wrong arguments@0.000 invariant@1.000");
  EXPECT_EQ(check_kinds(kCellar, "0: (strike m)\n1: (mend f) [3]"), "time@0.000 invariant@1.000");
  const World plain = {"(:predicates (done)) (:action beep :effect (done))", "(:init) (:goal (done))", ""};
  EXPECT_EQ(check_kinds(plain, "1: (beep) [2]"), "goal@0.000 time@1.000");
  EXPECT_EQ(check_kinds(plain, "1: (beep) [0]"), "");
}

TEST(Conditions, LogicOfConditions) {
  const auto holds = [](const std::string& goal) {
    const World world = {"(:types b - a) (:predicates (p) (q ?x - a)) (:functions (f))",
                         "(:objects x y - a z - b) (:init (p) (q x) (q z) (= (f) 3)) (:goal " + goal + ")",
                         ""};
    return check_kinds(world, "").empty();
  };
  EXPECT_TRUE(holds("(and)"));
  EXPECT_FALSE(holds("(or)"));
  EXPECT_TRUE(holds("(or (q y) (p))"));
  EXPECT_TRUE(holds("(not (q y))"));
  EXPECT_FALSE(holds("(not (p))"));
  EXPECT_TRUE(holds("(imply (q y) (q y))"));
  EXPECT_FALSE(holds("(imply (p) (q y))"));
  EXPECT_FALSE(holds("(forall (?x - a) (q ?x))"));
  EXPECT_TRUE(holds("(forall (?x - b) (q ?x))"));
  EXPECT_TRUE(holds("(forall (?x ?y - a) (imply (and (q ?x) (not (q ?y))) (not (= ?x ?y))))"));
  EXPECT_TRUE(holds("(exists (?x - a) (not (q ?x)))"));
  EXPECT_FALSE(holds("(exists (?x - b) (not (q ?x)))"));
  EXPECT_TRUE(holds("(exists (?x ?y - a) (and (not (= ?x ?y)) (q ?x) (q ?y)))"));
  EXPECT_TRUE(holds("(= x x)"));
  EXPECT_FALSE(holds("(= x y)"));
}

TEST(Conditions, TimedLiteralsAtTimeZeroArePartOfTheInitialState) {
  const std::string domain =
      "(:requirements :timed-initial-literals) (:predicates (open) (sent))"
      "(:action send :parameters () :precondition (open) :effect (sent))";
  for (const char* init : {"(at 0 (open))", "(at 0 (open)) (at 0 (not (open)))"})
    EXPECT_EQ(check_kinds({domain, "(:init " + std::string(init) + ") (:goal (sent))", ""}, "0: (send)"), "")
        << init;
  EXPECT_EQ(check_kinds({domain, "(:init (open) (at 0 (not (open)))) (:goal (sent))", ""}, "0: (send)"),
            "condition@0.000");
}

TEST(Conditions, WhatTimedLiteralsDeleteGoesBeforeWhatTheyAddAtThatTime) {
  const std::string domain =
      "(:requirements :timed-initial-literals) (:predicates (open) (sent))"
      "(:action send :parameters () :precondition (open) :effect (sent))";
  for (const char* init : {"(at 3 (open)) (at 3 (not (open)))", "(at 3 (not (open))) (at 3 (open))"})
    EXPECT_EQ(check_kinds({domain, "(:init " + std::string(init) + ") (:goal (sent))", ""}, "4: (send)"), "")
        << init;
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
