// What is long enough to hold what: which actions are left, and random envelopes against a count by hand.
#include "planner_svc/temporal_pddl/grounding/simplification/envelopes.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using task::Task;
using temporal::Verdict;

std::string envelope(const std::string& name, const std::string& fact, int seconds) {
  return "(:durative-action " + name + " :parameters () :duration (= ?duration " + std::to_string(seconds) +
         ") :condition () :effect (and (at start (" + fact + ")) (at end (not (" + fact + ")))))";
}

std::string content(const std::string& name, const std::string& fact, int seconds) {
  return "(:durative-action " + name + " :parameters () :duration (= ?duration " + std::to_string(seconds) +
         ") :condition (over all (" + fact + ")) :effect (at end (" + name + "-done)))";
}

std::size_t invariants(const Task& task, const char* of) {
  return task.invariants[testing::action(task, of)].size();
}

TEST(Envelopes, OnlyWhatSomeAreTooShortForIsToldApart) {
  const Task task =
      testing::grounded(
          testing::model("(:requirements :durative-actions) (:predicates (hot) (dry-done) (bake-done))" +
                             envelope("low", "hot", 4) + envelope("high", "hot", 9) +
                             content("dry", "hot", 4) + content("bake", "hot", 5),
                         "(:init) (:goal (and (dry-done) (bake-done)))"))
          .task;
  EXPECT_EQ(invariants(task, "(dry)"), 1u);
  EXPECT_EQ(invariants(task, "(bake)"), 2u);
  EXPECT_EQ(task.adds[task.actions[testing::action(task, "(low)")].start].size(), 1u);
  EXPECT_EQ(task.adds[task.actions[testing::action(task, "(high)")].start].size(), 2u);
}

TEST(Envelopes, WhatHoldsForOtherReasonsToo) {
  const std::string domain = "(:requirements :durative-actions) (:predicates (hot) (bake-done))" +
                             envelope("low", "hot", 4) + content("bake", "hot", 5);
  const auto problem = [](const char* init) {
    return "(:init " + std::string(init) + ") (:goal (bake-done))";
  };
  EXPECT_EQ(testing::solved(testing::model(domain, problem(""))).verdict, Verdict::unsolvable);
  const auto before = testing::model(domain, problem("(hot)"));
  testing::expect_valid(before, testing::solved(before));
  const auto sun = testing::model(domain, problem("(at 3 (hot))"));
  testing::expect_valid(sun, testing::solved(sun));
  const auto match =
      testing::model(domain + "(:action strike :parameters () :precondition () :effect (hot))", problem(""));
  testing::expect_valid(match, testing::solved(match));
}

// An envelope within an envelope, and contents for either; a goal can be reached if one of the envelopes
// suffices for it.
TEST(Envelopes, RandomOnesHoldWhatFits) {
  std::mt19937_64 random(11);
  int solvable = 0;
  for (int round = 0; round < 150; ++round) {
    const auto seconds = [&] { return 1 + static_cast<int>(random() % 7); };
    std::string domain = "(:requirements :durative-actions) (:predicates (hot)";
    std::string actions, goals;
    int longest = 0;
    for (int i = 0; i < 3; ++i) {
      const int own = seconds();
      longest = std::max(longest, own);
      actions += envelope("fire" + std::to_string(i), "hot", own);
    }
    bool expected = true;
    for (int i = 0; i < 3; ++i) {
      const int own = seconds();
      expected = expected && own <= longest;
      domain += " (c" + std::to_string(i) + "-done)";
      goals += " (c" + std::to_string(i) + "-done)";
      actions += content("c" + std::to_string(i), "hot", own);
    }
    const auto made = testing::model(domain + ")" + actions, "(:init) (:goal (and" + goals + "))");
    const Result result = testing::solved(made);
    EXPECT_EQ(result.verdict, expected ? Verdict::solved : Verdict::unsolvable) << round;
    if (expected) testing::expect_valid(made, result);
    solvable += expected;
  }
  EXPECT_GT(solvable, 20);
  EXPECT_LT(solvable, 130);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
