#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/grounding/invariants/compression_safety.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using grounding::invariants::Compression;
using task::Task;
using testing::action;

// One domain, each action a case of the criterion.
const Task& task() {
  static const Task made = testing::grounded(testing::model(R"(
    (:requirements :typing :durative-actions :numeric-fluents)
    (:types place)
    (:predicates (at ?p - place) (light) (mended) (seen ?p - place) (known) (used) (stamped))
    (:functions (energy))
    (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration 5)
      :condition (at start (at ?a)) :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action match :parameters () :duration (= ?duration 5)
      :condition () :effect (and (at start (light)) (at end (not (light)))))
    (:durative-action mend :parameters () :duration (= ?duration 2)
      :condition (over all (light)) :effect (at end (mended)))
    (:durative-action mend-late :parameters () :duration (= ?duration 2)
      :condition (at end (light)) :effect (at end (mended)))
    (:durative-action see :parameters (?p - place) :duration (= ?duration 2)
      :condition (over all (at ?p)) :effect (at end (seen ?p)))
    (:durative-action learn :parameters () :duration (= ?duration 2)
      :condition () :effect (at end (known)))
    (:durative-action learn-otherwise :parameters () :duration (= ?duration 2)
      :condition () :effect (at end (known)))
    (:durative-action use :parameters () :duration (= ?duration 1)
      :condition (and (at start (known)) (at start (seen a)) (at start (>= (energy) 1))) :effect (at end (used)))
    (:durative-action charge :parameters () :duration (= ?duration 3)
      :condition () :effect (at end (increase (energy) 1)))
    (:constants a b - place))",
                                                            R"((:init (at a) (= (energy) 0))
    (:goal (and (mended) (used) (at b) (seen b))))"))
                               .task;
  return made;
}

bool safe(const char* name) { return task().actions[action(task(), name)].compression_safe; }

TEST(Compression, WhatIsIsolatedMayChangeEarly) { EXPECT_TRUE(safe("(drive a b)")); }

TEST(Compression, AnEnvelopeMayNotEndEarly) { EXPECT_FALSE(safe("(match)")); }

TEST(Compression, WhatOnlyGoalsAskForMayBeAddedEarly) {
  EXPECT_TRUE(safe("(mend)"));
  EXPECT_TRUE(safe("(use)"));
}

TEST(Compression, AConditionAtTheEndAloneMayNeedOthersFirst) { EXPECT_FALSE(safe("(mend-late)")); }

TEST(Compression, ASoleAdderIsSafeWhileTheFactIsFalse) {
  EXPECT_TRUE(safe("(see a)"));
  const auto absent = task().absent_for_compression[action(task(), "(see a)")];
  ASSERT_EQ(absent.size(), 1u);
  EXPECT_EQ(name(task(), absent[0]), "(seen a)");
}

TEST(Compression, SeveralAddersOfWhatOthersReadAreNot) {
  EXPECT_FALSE(safe("(learn)"));
  EXPECT_FALSE(safe("(learn-otherwise)"));
}

TEST(Compression, NumbersThatOthersReadAreNot) { EXPECT_FALSE(safe("(charge)")); }

// Jobs that hold one of two keys at the same time: two find one each, three do not, which no pair of facts shows, so
// that all states are looked at.
testing::Model jobs(int count) {
  std::string objects, init, goal;
  for (int i = 0; i < count; ++i) {
    const std::string job = " j" + std::to_string(i);
    objects += job;
    init += "(idle" + job + ")";
    goal += "(busy" + job + ")";
  }
  return testing::model(R"((:requirements :typing :durative-actions) (:types job key)
    (:predicates (idle ?j - job) (busy ?j - job) (free ?k - key) (holds ?j - job ?k - key))
    (:durative-action take :parameters (?j - job ?k - key) :duration (= ?duration 5)
      :condition (and (at start (idle ?j)) (at start (free ?k)))
      :effect (and (at start (not (idle ?j))) (at start (not (free ?k))) (at end (busy ?j)) (at end (holds ?j ?k))))
    (:durative-action give :parameters (?j - job ?k - key) :duration (= ?duration 5)
      :condition (and (at start (busy ?j)) (at start (holds ?j ?k)))
      :effect (and (at start (not (busy ?j))) (at start (not (holds ?j ?k))) (at end (idle ?j)) (at end (free ?k)))))",
                        "(:objects" + objects + " - job k l - key) (:init (free k) (free l) " + init +
                            ") (:goal (and " + goal + "))");
}

// R14: the same verdicts with it and without, and with it a half of the states at most.
TEST(Compression, SparesStatesAndKeepsSolvability) {
  call::Options with, without;
  without.compression_safety = false;
  EXPECT_EQ(testing::solved(jobs(2), with).verdict, temporal::Verdict::solved);
  EXPECT_EQ(testing::solved(jobs(2), without).verdict, temporal::Verdict::solved);
  const Result few = testing::solved(jobs(3), with), many = testing::solved(jobs(3), without);
  EXPECT_EQ(few.verdict, temporal::Verdict::unsolvable) << few.reason;
  EXPECT_EQ(many.verdict, temporal::Verdict::unsolvable) << many.reason;
  EXPECT_GT(few.statistics.evaluated, 5u) << few.reason;
  EXPECT_LE(2 * few.statistics.evaluated, many.statistics.evaluated);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
