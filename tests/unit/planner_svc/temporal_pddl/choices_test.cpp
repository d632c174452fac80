// What a condition mentions counts as read, whether or not the alternative that holds asks for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/pddl/printer.hpp"
#include "tests/unit/planner_svc/temporal_pddl/brute_force.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_choices.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget, call::Options, call::WindowExtraction;
using task::Action, task::FactId, task::SnapId, task::Task, task::VariableId;
using temporal::Duration, temporal::Verdict;
using ::testing::UnorderedElementsAre;

// What the snap action reads, by name.
std::set<std::string> reads(const Task& task, SnapId snap) {
  std::set<std::string> result;
  for (const VariableId variable : task.reads[snap]) {
    const std::size_t facts = task.fact_names.size();
    result.insert(variable.index() < facts ? name(task, FactId(variable.index()))
                                           : task.number_names[variable.index() - facts]);
  }
  return result;
}

class Choices : public ::testing::Test {
 protected:
  // The reads of the start and of the end of (look), in a world in which p, q, x and what d hangs on change,
  // and (always) and (quiet) do not.
  void look(const std::string& conditions, const std::string& effects = "") {
    const auto made = testing::model(R"((:requirements :durative-actions :derived-predicates
        :disjunctive-preconditions :conditional-effects :numeric-fluents :negative-preconditions)
      (:predicates (p) (q) (d) (quiet) (always) (seen) (gone))
      (:functions (x))
      (:derived (d) (or (q) (> (x) 2)))
      (:action change :parameters () :precondition ()
        :effect (and (not (p)) (q) (increase (x) 1) (not (gone))))
      (:durative-action look :parameters () :duration (= ?duration 1)
        :condition (and )" + conditions + ") :effect (and (at end (seen)) " +
                                         effects + "))",
                                     "(:init (p) (quiet) (always) (= (x) 0)) (:goal (and (seen) (q)))");
    const Task task = testing::grounded(made).task;
    start = end = {};
    for (const Action& action : task.actions) {
      if (task.schemas[action.schema.index()] != "look") continue;
      start.merge(reads(task, action.start));
      end.merge(reads(task, action.end));
    }
  }

  std::set<std::string> start, end;
};

TEST_F(Choices, WhatNeverChangesDecides) {
  look("(at start (or (always) (p)))");
  EXPECT_THAT(start, UnorderedElementsAre("(p)"));
  look("(at end (imply (not (always)) (p)))");
  EXPECT_THAT(start, UnorderedElementsAre());
  EXPECT_THAT(end, UnorderedElementsAre("(p)"));
  look("(at start (or (always) (and (not (always)) (q) (> (x) 1))))");
  EXPECT_THAT(start, UnorderedElementsAre("(q)", "(x)"));
}

TEST_F(Choices, WhatNobodyChangesNeedsNoReading) {
  look("(at start (or (always) (quiet)))");
  EXPECT_THAT(start, UnorderedElementsAre());
}

TEST_F(Choices, WhatIsNeverTrueAndYetDeleted) {
  look("(at start (or (gone) (p)))");
  EXPECT_THAT(start, UnorderedElementsAre("(gone)", "(p)"));
}

TEST_F(Choices, WhatDerivedFactsHangOn) {
  look("(at start (or (always) (d)))");
  EXPECT_THAT(start, UnorderedElementsAre("(q)", "(x)"));
}

TEST_F(Choices, ConditionsOfEffectsThatNeverHappen) {
  look("(at start (p))", "(at end (when (and (q) (not (always))) (p)))");
  EXPECT_THAT(end, UnorderedElementsAre("(q)"));
}

TEST_F(Choices, OverAllNothingIsReadAtOneMoment) {
  look("(over all (or (always) (p)))");
  EXPECT_THAT(start, UnorderedElementsAre());
}

// Two actions of 0 s would like to be at the same moment.
TEST(ChoicesInPlans, StandApart) {
  const auto made = testing::model(R"((:requirements :durative-actions :disjunctive-preconditions)
    (:predicates (p) (always) (a) (b))
    (:durative-action drop :parameters () :duration (= ?duration 1)
      :condition (at start (p)) :effect (and (at start (not (p))) (at end (a))))
    (:durative-action look :parameters () :duration (= ?duration 1)
      :condition (at start (or (always) (p))) :effect (at end (b))))",
                                   "(:init (p) (always)) (:goal (and (a) (b)))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  EXPECT_EQ(result.plan->makespan, Duration{1001000});
}

TEST(ChoicesInPlans, AWindowThatIsOnlyMentioned) {
  const auto made =
      testing::model(R"((:requirements :durative-actions :disjunctive-preconditions :timed-initial-literals)
    (:predicates (light) (always) (done))
    (:durative-action work :parameters () :duration (= ?duration 3)
      :condition (and (at end (or (always) (light))) (over all (light))) :effect (at end (done))))",
                     "(:init (always) (at 2 (light)) (at 5 (not (light)))) (:goal (done))");
  const Result result = testing::solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable) << "it would end as the light goes";
}

class ChoicesAgainstBruteForce : public ::testing::TestWithParam<int> {};

TEST_P(ChoicesAgainstBruteForce, AgreesOnSolvability) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  Budget budget;
  budget.evaluations = 1000;
  Options bare;
  bare.compression_safety = bare.dominance = bare.compress_all_actions = false;
  bare.windows = WindowExtraction::none;
  std::size_t solved = 0, unsolvable = 0;
  for (int round = 0; round < 300; ++round) {
    const bool conditional = round % 2 == 0;
    const testing::Model model = testing::random_choices_task(random, conditional);
    const bool expected = !conditional && testing::has_plan(model, 3);
    for (const Options& options : {Options{}, bare}) {
      const Result result = testing::solved(model, options, budget);
      if (result.plan) testing::expect_valid(model, result, options);
      if (expected) {
        EXPECT_NE(result.verdict, Verdict::unsolvable) << result.reason;
      }
      if (HasFailure()) FAIL() << pddl::print(model.domain) << pddl::print(model.problem);
      solved += result.verdict == Verdict::solved;
      unsolvable += result.verdict == Verdict::unsolvable;
    }
  }
  EXPECT_GT(solved, 80u);
  EXPECT_GT(unsolvable, 80u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ChoicesAgainstBruteForce, ::testing::Range(1, 7));

}  // namespace
}  // namespace roci::planner::temporal_pddl
