// Which happenings may stand closer than epsilon.
#include <gmock/gmock.h>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

const World kWorld = {
    "(:types thing) (:predicates (p) (q) (fixed) (r ?x - thing)) (:functions (f) (g))"
    "(:action add-p :effect (p)) (:action delete-p :effect (not (p))) (:action need-p :precondition (p) "
    ":effect ())"
    "(:action need-not-p :precondition (not (p)) :effect ()) (:action toggle :precondition (p) :effect (not "
    "(p)))"
    "(:action need-either :precondition (or (q) (p)) :effect ())"
    "(:action need-fixed-or-p :precondition (or (fixed) (p)) :effect ())"
    "(:action need-p-or-fixed :precondition (or (p) (fixed)) :effect ())"
    "(:action when-p :effect (when (p) (q))) (:action when-q :effect (when (q) (not (p))))"
    "(:action up :effect (increase (f) 1)) (:action down :effect (decrease (f) 2)) (:action set :effect "
    "(assign (f) 3))"
    "(:action read :precondition (>= (f) 0) :effect ()) (:action copy :effect (assign (g) (f)))"
    "(:action need-all :precondition (forall (?x - thing) (r ?x)) :effect ())"
    "(:action make :parameters (?x - thing) :effect (r ?x))",
    "(:objects a b - thing) (:init (p) (fixed) (r a) (r b) (= (f) 5))", ""};

bool interfere(const std::string& one, const std::string& other) {
  const std::string together = check_kinds(kWorld, "1: (" + one + ")\n1: (" + other + ")");
  const std::string apart = check_kinds(kWorld, "1: (" + one + ")\n1.001: (" + other + ")");
  EXPECT_EQ(apart.find("interference"), std::string::npos) << "epsilon is far enough";
  const std::string near = check_kinds(kWorld, "1: (" + one + ")\n1.0009: (" + other + ")");
  EXPECT_EQ(near.find("interference") != std::string::npos,
            together.find("interference") != std::string::npos);
  return together.find("interference") != std::string::npos;
}

TEST(Interference, OverFacts) {
  EXPECT_TRUE(interfere("add-p", "delete-p"));
  EXPECT_TRUE(interfere("add-p", "need-p")) << "even if it holds already";
  EXPECT_TRUE(interfere("need-p", "add-p"));
  EXPECT_TRUE(interfere("delete-p", "need-p"));
  EXPECT_TRUE(interfere("delete-p", "need-not-p"));
  EXPECT_TRUE(interfere("toggle", "toggle"));
  EXPECT_FALSE(interfere("add-p", "add-p"));
  EXPECT_FALSE(interfere("delete-p", "delete-p"));
  EXPECT_FALSE(interfere("need-p", "need-p"));
  EXPECT_FALSE(interfere("add-p", "up"));
}

TEST(Interference, OverAllThatAConditionMentions) {
  EXPECT_TRUE(interfere("need-either", "add-p"));
  EXPECT_TRUE(interfere("need-all", "make a"));
  EXPECT_TRUE(interfere("need-fixed-or-p", "add-p")) << "although what never changes decides";
  EXPECT_TRUE(interfere("need-p-or-fixed", "add-p"));
  EXPECT_FALSE(interfere("need-fixed-or-p", "up"));
}

TEST(Interference, OfConditionalEffects) {
  EXPECT_TRUE(interfere("when-p", "add-p")) << "their conditions are read";
  EXPECT_FALSE(interfere("when-q", "need-p")) << "q does not hold: no effect on p";
}

TEST(Interference, OverFluents) {
  EXPECT_FALSE(interfere("up", "down"));
  EXPECT_TRUE(interfere("up", "set"));
  EXPECT_TRUE(interfere("set", "set"));
  EXPECT_TRUE(interfere("up", "read"));
  EXPECT_TRUE(interfere("copy", "down"));
  EXPECT_FALSE(interfere("copy", "read"));
}

TEST(Interference, EpsilonIsAnOption) {
  Options options;
  options.epsilon = pddl::Microseconds(100000);
  EXPECT_EQ(check_kinds(kWorld, "1: (add-p)\n1.1: (delete-p)", options), "");
  EXPECT_EQ(check_kinds(kWorld, "1: (add-p)\n1.099: (delete-p)", options), "interference@1.099");
  options.epsilon = pddl::Microseconds(1);
  EXPECT_EQ(check_kinds(kWorld, "1: (add-p)\n1.000001: (delete-p)", options), "");
}

TEST(Interference, TimedFactsInterfereWithSteps) {
  World world = kWorld;
  world.problem = "(:objects a b - thing) (:init (p) (at 1 (p)) (at 1 (not (q))) (at 1 (= (f) 3)) (= (f) 0))";
  EXPECT_EQ(check_kinds(world, "1: (need-p)"), "interference@1.000");
  EXPECT_EQ(check_kinds(world, "1.0005: (need-p)"), "interference@1.0005");
  EXPECT_EQ(check_kinds(world, "1: (up)"), "interference@1.000");
  EXPECT_EQ(check_kinds(world, "1: (make a)"), "");
}

TEST(Interference, WithinOneAction) {
  const World world = {
      "(:predicates (p)) (:durative-action flash :parameters () :duration (<= ?duration 1)"
      " :effect (and (at start (p)) (at end (not (p)))))",
      "(:init)", ""};
  EXPECT_EQ(check_kinds(world, "0: (flash) [0.001]"), "");
  EXPECT_EQ(check_kinds(world, "0: (flash) [0]"), "interference@0.000");
}

TEST(Interference, TheReportNamesBothAndWhatItIsAbout) {
  const Report report = check_plan(kWorld, "1: (add-p)\n1: (delete-p)");
  ASSERT_EQ(report.violations.size(), 1u);
  EXPECT_EQ(report.violations[0].step, 1u);
  EXPECT_EQ(report.violations[0].message,
            "(delete-p) interferes over (p) with (add-p), 0.000 apart, less than 0.001");
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
