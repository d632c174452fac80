// Derived predicates: the fixed point against a closure of its own, known problems, random ones against brute
// force.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/task/derived_facts.hpp"
#include "tests/unit/planner_svc/temporal_pddl/brute_force.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_derived.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget, call::Options, call::WindowExtraction;
using task::DerivationRule, task::DerivedFacts, task::FactId, task::IdVector, task::StateLayout, task::Word;
using temporal::Verdict;

constexpr std::size_t kNodes = 6;

FactId edge(std::size_t a, std::size_t b) { return FactId(kNodes * a + b); }
FactId path(std::size_t a, std::size_t b) { return FactId(kNodes * (kNodes + a) + b); }
FactId no_path(std::size_t a, std::size_t b) { return FactId(kNodes * (2 * kNodes + a) + b); }
FactId apart(std::size_t a, std::size_t b) { return FactId(kNodes * (3 * kNodes + a) + b); }

TEST(DerivedFacts, AreTheTransitiveClosureAndWhatItsNegationImplies) {
  std::vector<DerivationRule> rules;
  for (std::size_t a = 0; a < kNodes; ++a) {
    for (std::size_t b = 0; b < kNodes; ++b) {
      rules.push_back({path(a, b), 0, {edge(a, b)}, {}});
      for (std::size_t c = 0; c < kNodes; ++c) rules.push_back({path(a, c), 0, {path(a, b), path(b, c)}, {}});
    }
  }
  IdVector<FactId, FactId> negation_of(4 * kNodes * kNodes);
  std::vector<std::vector<FactId>> variables;
  for (std::size_t a = 0; a < kNodes; ++a) {
    for (std::size_t b = 0; b < kNodes; ++b) {
      rules.push_back({apart(a, b), 1, {no_path(a, b), no_path(b, a)}, {}});
      negation_of[no_path(a, b)] = path(a, b);
      for (const FactId fact : {edge(a, b), path(a, b), apart(a, b)}) variables.push_back({fact});
    }
  }
  const StateLayout layout(variables, negation_of, 0);
  const DerivedFacts derived(rules);
  std::mt19937_64 random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<Word> state(layout.words(), round % 2 == 0 ? 0 : ~Word{0});  // what it was does not matter
    bool reached[kNodes][kNodes];
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = 0; b < kNodes; ++b) {
        reached[a][b] = random() % 5 == 0;
        reached[a][b] ? layout.add(state, edge(a, b)) : layout.remove(state, edge(a, b));
      }
    }
    for (std::size_t b = 0; b < kNodes; ++b) {
      for (std::size_t a = 0; a < kNodes; ++a) {
        for (std::size_t c = 0; c < kNodes; ++c) reached[a][c] |= reached[a][b] && reached[b][c];
      }
    }
    derived.complete(layout, {}, state);
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = 0; b < kNodes; ++b) {
        ASSERT_EQ(layout.holds(state, path(a, b)), reached[a][b]);
        ASSERT_EQ(layout.holds(state, apart(a, b)), !reached[a][b] && !reached[b][a]);
      }
    }
  }
}

// Switches connect lines; a lamp is lit as long as current reaches it; something must be seen by its light.
testing::Model wires(const std::string& init, const std::string& goal) {
  return testing::model(
      R"(
    (:requirements :typing :durative-actions :derived-predicates :negative-preconditions)
    (:types node)
    (:predicates (line ?a ?b - node) (closed ?a ?b - node) (source ?n - node) (powered ?n - node)
                 (seen ?n - node) (dark))
    (:derived (powered ?n - node)
      (or (source ?n) (exists (?m - node) (and (powered ?m) (line ?m ?n) (closed ?m ?n)))))
    (:derived (dark) (forall (?n - node) (imply (powered ?n) (source ?n))))
    (:action close :parameters (?a ?b - node)
      :precondition (and (line ?a ?b) (not (closed ?a ?b))) :effect (closed ?a ?b))
    (:action open :parameters (?a ?b - node) :precondition (closed ?a ?b) :effect (not (closed ?a ?b)))
    (:durative-action see :parameters (?n - node) :duration (= ?duration 10)
      :condition (over all (powered ?n)) :effect (at end (seen ?n))))",
      "(:objects a b c d - node) (:init (source a) (line a b) (line b c) (line a c) (line c d)" + init +
          ") (:goal " + goal + ")");
}

TEST(Derived, RecursionReachesThroughTheState) {
  const auto made = wires("", "(seen d)");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  EXPECT_EQ(result.plan->activities.size(), 3u);  // over a c d
}

TEST(Derived, NegationUnderAQuantifier) {
  const auto made = wires("(closed a b) (closed b c) (closed c d)", "(and (dark) (seen d))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
}

TEST(Derived, WhatNothingSupportsIsProvedUnreachable) {
  const auto made = testing::model(R"((:requirements :derived-predicates)
    (:predicates (p) (q) (r)) (:derived (q) (and (p) (r)))
    (:action a :parameters () :precondition (q) :effect (p)))",
                                   "(:init (r)) (:goal (q))");
  const Result result = testing::solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("(q)"));
}

TEST(Derived, AnInvariantMayHoldForOneReasonThenForAnother) {
  const auto made =
      testing::model(R"((:requirements :durative-actions :derived-predicates :timed-initial-literals)
    (:predicates (sun) (battery) (powered) (done))
    (:derived (powered) (or (sun) (battery)))
    (:durative-action switch-on :parameters () :duration (= ?duration 1)
      :condition () :effect (at end (battery)))
    (:durative-action work :parameters () :duration (= ?duration 8)
      :condition (over all (powered)) :effect (at end (done))))",
                     "(:init (sun) (at 5 (not (sun)))) (:goal (done))");
  for (const auto windows : {WindowExtraction::none, WindowExtraction::recurring}) {
    Options options;
    options.windows = windows;
    testing::expect_valid(made, testing::solved(made, options), options);
  }
}

TEST(Derived, NumbersCount) {
  const auto made = testing::model(R"((:requirements :durative-actions :derived-predicates :numeric-fluents)
    (:predicates (idle) (low) (done)) (:functions (charge))
    (:derived (low) (< (charge) 3))
    (:durative-action charge-up :parameters () :duration (= ?duration 2)
      :condition (at start (idle))
      :effect (and (at start (not (idle))) (at end (idle)) (at end (increase (charge) 1))))
    (:durative-action work :parameters () :duration (= ?duration 1)
      :condition (at start (not (low))) :effect (at end (done))))",
                                   "(:init (idle) (= (charge) 0)) (:goal (done))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  EXPECT_EQ(result.plan->activities.size(), 4u);
}

TEST(Derived, ADeadlineMayLieInWhatAGoalHangsOn) {
  const char* const domain = R"((:requirements :durative-actions :derived-predicates :timed-initial-literals)
    (:predicates (open) (there) (safe))
    (:derived (safe) (and (open) (there)))
    (:durative-action go :parameters () :duration (= ?duration 4)
      :condition () :effect (at end (there))))";
  const auto in_time = testing::model(domain, "(:init (open) (at 5 (not (open)))) (:goal (safe))");
  testing::expect_valid(in_time, testing::solved(in_time));
  const auto too_late = testing::model(domain, "(:init (open) (at 3 (not (open)))) (:goal (safe))");
  EXPECT_EQ(testing::solved(too_late).verdict, Verdict::unsolvable);
}

class DerivedAgainstBruteForce : public ::testing::TestWithParam<int> {};

TEST_P(DerivedAgainstBruteForce, AgreesOnSolvability) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  Budget budget;
  budget.evaluations = 2000;
  Options bare;
  bare.compression_safety = bare.dominance = false;
  bare.windows = WindowExtraction::none;
  std::size_t solved = 0, unsolvable = 0;
  for (int round = 0; round < 150; ++round) {
    const testing::Model model = testing::random_derived_task(random);
    const bool expected = testing::has_plan(model, 3);
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
  EXPECT_GT(solved, 40u);
  EXPECT_GT(unsolvable, 40u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DerivedAgainstBruteForce, ::testing::Range(1, 7));

}  // namespace
}  // namespace roci::planner::temporal_pddl
