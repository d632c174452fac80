// Numeric conditions and effects, durations, external functions, metrics.
#include <gmock/gmock.h>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

using ::testing::HasSubstr;

bool holds(const std::string& goal) {
  const World world = {"(:functions (f) (g) (undefined))", "(:init (= (f) 3) (= (g) 0)) (:goal " + goal + ")",
                       ""};
  return check_kinds(world, "").empty();
}

TEST(Numbers, Comparisons) {
  EXPECT_TRUE(holds("(< (f) 3.1)"));
  EXPECT_FALSE(holds("(< (f) 3)"));
  EXPECT_TRUE(holds("(<= (f) 3)"));
  EXPECT_TRUE(holds("(= (f) 3)"));
  EXPECT_FALSE(holds("(= (f) 2)"));
  EXPECT_TRUE(holds("(>= (f) 3)"));
  EXPECT_FALSE(holds("(> (f) 3)"));
  EXPECT_TRUE(holds("(= (+ (f) 1 2) (* 2 (f)))"));
  EXPECT_TRUE(holds("(= (- (f)) (- 0 3))"));
  EXPECT_TRUE(holds("(= (/ (f) 2) 1.5)"));
  EXPECT_TRUE(holds("(= (* 0.1 (f)) 0.3)")) << "but for rounding";
}

TEST(Numbers, WhatIsUndefinedIsNeitherTrueNorFalse) {
  EXPECT_FALSE(holds("(> (undefined) 0)"));
  EXPECT_FALSE(holds("(not (> (undefined) 0))"));
  EXPECT_FALSE(holds("(= (/ (f) (g)) 0)"));
  EXPECT_FALSE(holds("(not (= (/ (f) (g)) 0))"));
  EXPECT_TRUE(holds("(or (> (undefined) 0) (= (f) 3))"));
  EXPECT_FALSE(holds("(and (> (undefined) 0) (= (f) 3))"));
  EXPECT_TRUE(holds("(imply (= (f) 4) (> (undefined) 0))"));
  EXPECT_FALSE(holds("(or (and (> (undefined) 0) (= (f) 3)) (= (f) 4))"));
  EXPECT_FALSE(holds("(not (or (> (undefined) 0) (= (f) 4)))"));
  EXPECT_TRUE(holds("(not (and (> (undefined) 0) (= (f) 4)))"));
}

TEST(Numbers, Effects) {
  const World world = {
      "(:functions (f) (g) (h)) (:action a :effect (and (increase (f) 2) (assign (g) (f)) (scale-up (h) 3)))"
      "(:action b :effect (and (decrease (f) (g)) (scale-down (h) 2)))",
      "(:init (= (f) 10) (= (h) 4)) (:goal (and (= (f) 2) (= (g) 10) (= (h) 6)))", ""};
  EXPECT_EQ(check_kinds(world, "1: (a)\n2: (b)"), "") << "values are those before the happening";
  EXPECT_EQ(check_kinds(world, "1: (b)\n2: (a)"), "undefined value@1.000 goal@2.000");
}

TEST(Numbers, EffectsOnWhatIsUndefined) {
  const World world = {
      "(:functions (f) (g)) (:action a :effect (increase (f) 2)) (:action b :effect (assign (f) (g)))"
      "(:action c :effect (scale-down (f) 0))",
      "(:init)", ""};
  EXPECT_EQ(check_kinds(world, "1: (a)"), "undefined value@1.000");
  EXPECT_EQ(check_kinds(world, "1: (b)"), "undefined value@1.000");
  World defined = world;
  defined.problem = "(:init (= (f) 1) (= (g) 1))";
  EXPECT_EQ(check_kinds(defined, "1: (a)\n2: (b)"), "");
  EXPECT_EQ(check_kinds(defined, "1: (c)"), "undefined value@1.000") << "infinite";
}

TEST(Numbers, OneHappeningSetsAFluentInOneWay) {
  const World world = {
      "(:functions (f)) (:action a :effect (and (increase (f) 2) (increase (f) 3)))"
      "(:action b :effect (and (increase (f) 2) (assign (f) 3)))",
      "(:init (= (f) 0))", ""};
  EXPECT_EQ(check_kinds(world, "1: (a)"), "");
  EXPECT_EQ(check_kinds(world, "1: (b)"), "conflicting effects@1.000");
}

// Charging from (level) to 80 at (rate) per second, as in Rovers Metric Time (R1).
const World kCharge = {
    "(:functions (level) (rate)) (:durative-action charge :parameters ()"
    " :duration (= ?duration (/ (- 80 (level)) (rate)))"
    " :condition (at start (<= (level) 80)) :effect (at end (increase (level) (* ?duration (rate)))))"
    "(:durative-action wait :parameters () :duration (and (>= ?duration 2) (<= ?duration 4)) :effect ())",
    "(:init (= (level) 0) (= (rate) 11)) (:goal (= (level) 80))", ""};

TEST(Numbers, DurationsMayBeRounded) {
  EXPECT_EQ(check_kinds(kCharge, "0: (charge) [7.273]"), "")
      << "80 / 11 = 7.27272…; the effect has the exact value";
  EXPECT_EQ(check_kinds(kCharge, "0: (charge) [7.272727]"), "");
  EXPECT_EQ(check_kinds(kCharge, "0: (charge) [7.274]"), "time@0.000 goal@7.274");
  EXPECT_EQ(check_kinds(kCharge, "0: (charge) [7.272]"), "time@0.000 goal@7.272");
}

TEST(Numbers, DurationBounds) {
  const std::string charge = "0: (charge) [7.273]\n";
  EXPECT_EQ(check_kinds(kCharge, charge + "0: (wait) [2]"), "");
  EXPECT_EQ(check_kinds(kCharge, charge + "0: (wait) [4]"), "");
  EXPECT_EQ(check_kinds(kCharge, charge + "0: (wait) [1.999]"), "time@0.000");
  EXPECT_EQ(check_kinds(kCharge, charge + "0: (wait) [4.001]"), "time@0.000");
  const Report report = check_plan(kCharge, charge + "0: (wait) [5]");
  EXPECT_EQ(report.violations.at(0).condition, "(<= ?duration 4)");
  EXPECT_THAT(report.violations[0].message, HasSubstr("duration 5 against (<= ?duration 4), which is 4"));
}

TEST(Numbers, DurationBoundsAtTheEnd) {
  const World world = {
      "(:functions (f)) (:action set :effect (assign (f) 5)) (:durative-action run :parameters ()"
      " :duration (at end (= ?duration (f))) :effect ())",
      "(:init (= (f) 1))", ""};
  EXPECT_EQ(check_kinds(world, "0: (run) [5]\n2: (set)"), "");
  EXPECT_EQ(check_kinds(world, "0: (run) [5]\n7: (set)"), "time@5.000");
}

TEST(Numbers, ExternalFunctions) {
  World world = {
      "(:types place) (:predicates (at ?p - place)) (:functions (energy))"
      "(:modules (:module nav (:function (time ?a ?b - place)) (:function (cost ?a ?b - place))))"
      "(:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))"
      " :condition (at start (and (at ?a) (>= (energy) (cost ?a ?b))))"
      " :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (decrease (energy) (cost ?a ?b)))))",
      "(:objects a b c - place) (:init (at a) (= (energy) 10)) (:goal (at b))",
      "(time a b) 12.5\n(cost a b) 10\n(time b c) unreachable\n(cost b c) 0"};
  EXPECT_EQ(check_kinds(world, "0: (drive a b) [12.5]"), "");
  EXPECT_EQ(check_kinds(world, "0: (drive a b) [12]"), "time@0.000");
  world.problem = "(:objects a b c - place) (:init (at b) (= (energy) 10)) (:goal (at c))";
  const Report unreachable = check_plan(world, "0: (drive b c) [1]");
  EXPECT_EQ(kinds(unreachable), "time@0.000");
  EXPECT_THAT(unreachable.violations[0].message, HasSubstr("external function (time b c) is unreachable"));
  EXPECT_THAT(check_plan(world, "0: (drive b a) [1]").violations.at(0).message,
              HasSubstr("external function (time b a) has no value"));
}

TEST(Numbers, MetricAndMakespanOfValidPlans) {
  World world = kCharge;
  world.problem += "(:metric minimize (+ (* 2 (total-time)) (level)))";
  const Report report = check_plan(world, "0: (charge) [7.273]\n6: (wait) [4]");
  EXPECT_EQ(report.makespan, pddl::Microseconds(10'000'000));
  ASSERT_TRUE(report.metric);
  EXPECT_DOUBLE_EQ(*report.metric, 100);
  EXPECT_FALSE(check_plan(world, "0: (charge) [7]").metric);
}

TEST(Numbers, FailedComparisonsShowTheirSides) {
  const World world = {"(:functions (f)) (:action a :precondition (>= (f) (+ 2 3)) :effect ())",
                       "(:init (= (f) 3))", ""};
  EXPECT_THAT(check_plan(world, "1: (a)").violations.at(0).message, HasSubstr("does not hold: 3 against 5"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
