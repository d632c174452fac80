// What the search makes of actions that must run at the same time, and of those that need not.
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options;

// Each match burns for 5 s, long enough to mend two fuses, one after the other; there are just enough.
testing::Model cellar(int fuses) {
  std::string objects, init = "(:init (handfree)", goal;
  for (int i = 0; i < fuses; ++i) {
    const std::string fuse = "f" + std::to_string(i);
    objects += " " + fuse + " - fuse";
    goal += " (mended " + fuse + ")";
    if (i % 2 == 0) {
      objects += " m" + std::to_string(i) + " - match";
      init += " (unused m" + std::to_string(i) + ")";
    }
  }
  return testing::model(R"((:requirements :typing :durative-actions) (:types match fuse)
    (:predicates (handfree) (unused ?m - match) (light ?m - match) (mended ?f - fuse))
    (:durative-action light-match :parameters (?m - match) :duration (= ?duration 5)
      :condition (at start (unused ?m))
      :effect (and (at start (not (unused ?m))) (at start (light ?m)) (at end (not (light ?m)))))
    (:durative-action mend :parameters (?f - fuse ?m - match) :duration (= ?duration 2)
      :condition (and (at start (handfree)) (over all (light ?m)))
      :effect (and (at start (not (handfree))) (at end (handfree)) (at end (mended ?f)))))",
                        "(:objects" + objects + ")" + init + ") (:goal (and" + goal + "))");
}

TEST(RequiredConcurrency, NoMatchIsTakenForLongerThanItBurns) {
  const testing::Model made = cellar(24);
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  ASSERT_TRUE(result.plan);
  EXPECT_LT(result.statistics.evaluated, 2000u);
}

// R12, R26: the match outlasts the fuses only if each of them is mended quickly. States in which the same
// fuses are mended differ in nothing but the time that is left; and the goals hold while it still burns,
// which has to end.
TEST(RequiredConcurrency, AStateReachedInLessTimeIsNoDuplicate) {
  const std::string slowly = "mend-slowly :parameters (?f - fuse) :duration (= ?duration 3)";
  const std::string quickly = "mend-quickly :parameters (?f - fuse) :duration (= ?duration 2)";
  for (const auto& ways : {std::vector{slowly, quickly}, {quickly, slowly}}) {
    std::string domain = R"((:requirements :typing :durative-actions) (:types fuse)
      (:predicates (handfree) (unused) (light) (mended ?f - fuse))
      (:durative-action light-match :parameters () :duration (= ?duration 9)
        :condition (at start (unused))
        :effect (and (at start (not (unused))) (at start (light)) (at end (not (light))))))";
    for (const std::string& way : ways) {
      domain += "(:durative-action " + way + R"(
        :condition (and (at start (handfree)) (over all (light)))
        :effect (and (at start (not (handfree))) (at end (handfree)) (at end (mended ?f)))))";
    }
    const testing::Model made =
        testing::model(domain,
                       "(:objects f0 f1 f2 f3 - fuse) (:init (handfree) (unused))"
                       "(:goal (and (mended f0) (mended f1) (mended f2) (mended f3)))");
    Options step_by_step;
    step_by_step.lookahead = false;
    for (const Options& options : {Options{}, step_by_step})
      testing::expect_valid(made, testing::solved(made, options), options);
  }
}

TEST(WholeActions, HalveTheWorkWhereNothingMustRunAtTheSameTime) {
  std::string objects, goal;
  for (int i = 0; i < 20; ++i) {
    objects += " r" + std::to_string(i);
    goal += " (clean r" + std::to_string(i) + ")";
  }
  // The end asks for what another action may undo: it is not compression safe.
  const testing::Model made =
      testing::model(R"((:requirements :durative-actions)
    (:predicates (lit) (clean ?r))
    (:durative-action sweep :parameters (?r) :duration (= ?duration 3)
      :condition (at end (lit)) :effect (at end (clean ?r)))
    (:durative-action darken :parameters () :duration (= ?duration 1)
      :condition () :effect (at end (not (lit)))))",
                     "(:objects" + objects + ") (:init (lit)) (:goal (and" + goal + "))");
  Options step_by_step;
  step_by_step.lookahead = false;
  step_by_step.best_first_width = step_by_step.goal_serialization = false;
  Options split = step_by_step;
  split.compress_all_actions = false;
  const Result whole = testing::solved(made, step_by_step);
  const Result parts = testing::solved(made, split);
  testing::expect_valid(made, whole);
  ASSERT_TRUE(whole.plan && parts.plan);
  EXPECT_EQ(whole.statistics.evaluated, 20u);
  EXPECT_EQ(parts.statistics.evaluated, 40u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
