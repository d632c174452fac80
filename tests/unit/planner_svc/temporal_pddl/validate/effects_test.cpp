// Conditional and quantified effects, and derived predicates.
#include <gmock/gmock.h>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

TEST(Effects, AddsWinOverDeletesOfTheSameHappening) {
  const World world = {"(:predicates (p)) (:action a :effect (and (p) (not (p))))", "(:init) (:goal (p))",
                       ""};
  EXPECT_EQ(check_kinds(world, "1: (a)"), "");
}

TEST(Effects, ForallAndWhenSeeTheStateBefore) {
  const World world = {
      "(:types t) (:predicates (p ?x - t) (q ?x - t))"
      "(:action swap :effect (forall (?x - t) (and (when (p ?x) (and (not (p ?x)) (q ?x)))"
      " (when (q ?x) (and (not (q ?x)) (p ?x))))))",
      "(:objects a b c - t) (:init (p a) (q b)) (:goal (and (q a) (not (p a)) (p b) (not (q b))"
      " (not (p c)) (not (q c))))",
      ""};
  EXPECT_EQ(check_kinds(world, "1: (swap)"), "");
  EXPECT_EQ(check_kinds(world, "1: (swap)\n2: (swap)"), "goal@2.000 goal@2.000 goal@2.000 goal@2.000");
}

// The end adds (start) if p held at the start, (end) if it held at the end, (all) if it held all the time
// between.
const World kRemember = {
    "(:predicates (p) (start) (end) (all)) (:action on :effect (p)) (:action off :effect (not (p)))"
    "(:durative-action watch :parameters () :duration (= ?duration 10) :effect (and"
    " (when (at start (p)) (at end (start))) (at end (when (p) (end))) (when (over all (p)) (at end "
    "(all)))))",
    "(:init)", ""};

std::string remembered(const std::string& plan) {
  std::string facts;
  for (const char* fact : {"start", "end", "all"}) {
    World world = kRemember;
    world.problem += "(:goal (" + std::string(fact) + "))";
    if (check_kinds(world, "1: (watch) [10]\n" + plan).empty()) facts += std::string(fact) + " ";
  }
  return facts;
}

TEST(Effects, ConditionsOfEffectsAreSeenAtTheirTimes) {
  EXPECT_EQ(remembered(""), "");
  EXPECT_EQ(remembered("0: (on)"), "start end all ");
  EXPECT_EQ(remembered("0: (on)\n5: (off)"), "start ");
  EXPECT_EQ(remembered("0: (on)\n5: (off)\n6: (on)"), "start end ");
  EXPECT_EQ(remembered("5: (on)"), "end ");
  EXPECT_EQ(remembered("12: (on)"), "");
}

const World kBlocks = {
    "(:types block) (:predicates (on ?x ?y - block) (above ?x ?y - block) (clear ?x - block) (free ?x ?y - "
    "block))"
    "(:derived (above ?x ?y - block) (or (on ?x ?y) (exists (?z - block) (and (on ?x ?z) (above ?z ?y)))))"
    "(:derived (clear ?x - block) (not (exists (?y - block) (above ?y ?x))))"
    "(:derived (free ?x ?y - block) (and (clear ?x) (clear ?y)))"
    "(:action take :parameters (?x ?y - block) :precondition (and (on ?x ?y) (clear ?x)) :effect (not (on ?x "
    "?y)))"
    "(:action stack :parameters (?x ?y - block) :precondition (free ?x ?y) :effect (on ?x ?y))",
    "(:objects a b c d - block) (:init (on a b) (on b c))", ""};

bool derived_goal(const std::string& goal, const std::string& plan = "") {
  World world = kBlocks;
  world.problem += "(:goal " + goal + ")";
  return check_kinds(world, plan).empty();
}

TEST(Derived, RecursionAndNegation) {
  EXPECT_TRUE(derived_goal("(above a c)"));
  EXPECT_FALSE(derived_goal("(above c a)"));
  EXPECT_FALSE(derived_goal("(above a d)"));
  EXPECT_TRUE(derived_goal("(and (clear a) (clear d) (not (clear b)) (not (clear c)))"));
  EXPECT_TRUE(derived_goal("(free a d)"));
  EXPECT_FALSE(derived_goal("(free a b)"));
}

TEST(Derived, FollowsTheState) {
  EXPECT_TRUE(derived_goal("(and (clear b) (above d a) (not (above a c)))", "1: (take a b)\n2: (stack d a)"));
  EXPECT_FALSE(derived_goal("(and)", "1: (take b c)")) << "b is not clear";
}

TEST(Derived, CyclesOfSupportSupportNothing) {
  const World world = {"(:predicates (a) (b) (c)) (:derived (a) (b)) (:derived (b) (or (a) (c)))",
                       "(:init) (:goal (or (a) (b)))", ""};
  EXPECT_EQ(check_kinds(world, ""), "goal@0.000");
  World supported = world;
  supported.problem = "(:init (c)) (:goal (and (a) (b)))";
  EXPECT_EQ(check_kinds(supported, ""), "");
}

TEST(Derived, InterferesOverWhatItRestsOn) {
  EXPECT_THAT(check_kinds(kBlocks, "1: (take a b)\n1: (stack d a)"),
              ::testing::HasSubstr("interference@1.000"));
}

TEST(Derived, LongChainsSettle) {
  World world = {
      "(:types n) (:predicates (next ?x ?y - n) (reach ?x - n) (root ?x - n))"
      "(:derived (reach ?y - n) (or (root ?y) (exists (?x - n) (and (next ?x ?y) (reach ?x)))))",
      "", ""};
  std::string objects, init;
  for (int i = 0; i < 150; ++i) {
    objects += " n" + std::to_string(i);
    if (i > 0) init += "(next n" + std::to_string(i - 1) + " n" + std::to_string(i) + ")";
  }
  world.problem = "(:objects" + objects + " - n) (:init (root n0)" + init + ") (:goal (reach n149))";
  EXPECT_EQ(check_kinds(world, ""), "");
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
