#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {

using engine::NoFunctions;

namespace {

using call::Budget, call::Monitor, call::Options, call::Statistics;
using extraction::to_ipc;
using temporal::Verdict;

// Counts x up to a goal that needs many steps, without an end if the goal is out of reach.
testing::Model counting(int goal) {
  return testing::model(
      R"((:requirements :numeric-fluents) (:predicates (odd)) (:functions (x) (y))
    (:action up :parameters () :precondition () :effect (increase (x) 1))
    (:action down :parameters () :precondition () :effect (decrease (y) 1)))",
      "(:init (= (x) 0) (= (y) 0)) (:goal (and (= (x) " + std::to_string(goal) + ") (= (y) 0.5)))");
}

Result plan_with(const Budget& budget, const Monitor& monitor) {
  const auto model = counting(5);
  NoFunctions functions;
  return plan(model.domain, model.problem, functions, budget, monitor);
}

TEST(Budget, Evaluations) {
  Budget budget;
  budget.evaluations = 100;
  const Result result = plan_with(budget, {});
  EXPECT_EQ(result.verdict, Verdict::timeout);
  EXPECT_EQ(result.statistics.evaluated, 101u);
  EXPECT_FALSE(result.reason.empty());
}

TEST(Budget, Time) {
  int polls = 0;
  Budget budget;
  budget.out_of_time = [&] { return ++polls > 50; };
  EXPECT_EQ(plan_with(budget, {}).verdict, Verdict::timeout);
  EXPECT_EQ(polls, 51);
}

TEST(Budget, Memory) {
  const auto wide = testing::model(
      R"((:requirements :typing :numeric-fluents) (:types t) (:predicates (p)) (:functions (x ?i - t))
    (:action up :parameters (?i - t) :precondition () :effect (increase (x ?i) 1)))",
      "(:objects a b c d e f g h - t) (:init (= (x a) 0) (= (x b) 0) (= (x c) 0) (= (x d) 0) (= (x e) 0)"
      " (= (x f) 0) (= (x g) 0) (= (x h) 0)) (:goal (= (+ (x a) (x b) (x c) (x d) (x e) (x f) (x g) (x h)) "
      "99.5))");
  Budget budget;
  budget.memory_bytes = 3 << 20;
  NoFunctions functions;
  const Result result = plan(wide.domain, wide.problem, functions, budget, {});
  EXPECT_EQ(result.verdict, Verdict::out_of_memory);
  EXPECT_GT(result.statistics.peak_bytes, std::size_t{3} << 20);
  EXPECT_LT(result.statistics.peak_bytes, std::size_t{6} << 20);
}

// n³ instances, twice if the goal is (r ...); by default it holds: all the work is grounding.
testing::Model wide(int n, const std::string& goal = "(not (q o0 o0 o0))") {
  std::string objects, init;
  for (int i = 0; i < n; ++i) {
    objects += " o" + std::to_string(i);
    init += " (p o" + std::to_string(i) + ")";
  }
  return testing::model(R"((:requirements :typing :durative-actions) (:types t)
    (:predicates (p ?a - t) (q ?a ?b ?c - t) (r ?a ?b ?c - t))
    (:action b :parameters (?a ?b ?c - t) :precondition (q ?a ?b ?c) :effect (r ?a ?b ?c))
    (:durative-action a :parameters (?a ?b ?c - t) :duration (= ?duration 1)
      :condition (and (at start (p ?a)) (at start (p ?b)) (at start (p ?c)))
      :effect (and (at start (not (p ?a))) (at end (p ?a)) (at end (q ?a ?b ?c)))))",
                        "(:objects" + objects + " - t) (:init" + init + ") (:goal " + goal + ")");
}

TEST(Budget, GroundingIsWithinTheMemoryToo) {
  const auto model = wide(20);
  Budget budget;
  budget.memory_bytes = 1 << 20;
  NoFunctions functions;
  const Result result = plan(model.domain, model.problem, functions, budget, {});
  EXPECT_EQ(result.verdict, Verdict::out_of_memory);
  EXPECT_LT(result.statistics.peak_bytes, std::size_t{1200} << 10);
  EXPECT_EQ(result.statistics.evaluated, 0u);
}

// Their table would take over 90 MB.
TEST(Budget, PairsOfFactsAreLeftOutWhereThereAreTooMany) {
  const auto model = wide(24, "(and (r o0 o1 o2) (r o2 o1 o0))");
  NoFunctions functions;
  Options options;
  const Result usual = plan(model.domain, model.problem, functions, {}, {}, options);
  options.pair_patience = 0;
  const Result with_pairs = plan(model.domain, model.problem, functions, {}, {}, options);
  EXPECT_EQ(with_pairs.verdict, Verdict::solved);
  EXPECT_LT(with_pairs.statistics.peak_bytes, usual.statistics.peak_bytes + (std::size_t{16} << 20));
}

// The work between two polls is bounded: each phase of grounding polls at least once in 256 instances.
TEST(Budget, GroundingPollsOftenEnough) {
  const std::size_t passes =
      11;  // over all instances, from the joins to the task; 7 without pruning and compression
  const auto model = wide(16);
  std::size_t polls = 0;
  Monitor monitor;
  monitor.cancelled = [&] {
    ++polls;
    return false;
  };
  NoFunctions functions;
  EXPECT_EQ(plan(model.domain, model.problem, functions, {}, monitor).verdict, Verdict::solved);
  const std::size_t all = polls;
  EXPECT_GE(all, passes * 16 * 16 * 16 / 256);
  for (std::size_t last = 1; last < all; last += all / 7) {  // wherever it is cancelled, it stops there
    polls = 0;
    monitor.cancelled = [&] { return ++polls >= last; };
    EXPECT_EQ(plan(model.domain, model.problem, functions, {}, monitor).verdict, Verdict::cancelled);
    EXPECT_EQ(polls, last);
  }
}

TEST(Budget, ImprovementPollsAtEachEvaluation) {
  const auto model = testing::model(R"((:requirements :typing :durative-actions)
    (:types t) (:predicates (p ?x - t) (q ?x - t))
    (:durative-action a :parameters (?x - t) :duration (= ?duration 2) :condition (at start (q ?x))
      :effect (and (at start (not (q ?x))) (at end (p ?x)) (at end (q ?x))))
    (:durative-action b :parameters (?x - t) :duration (= ?duration 3) :condition (at start (q ?x))
      :effect (and (at start (not (q ?x))) (at end (p ?x)) (at end (q ?x)))))",
                                    "(:objects a b c d e f - t) (:init (q a) (q b) (q c) (q d) (q e) (q f))"
                                    "(:goal (and (p a) (p b) (p c) (p d) (p e) (p f)))");
  std::size_t polls = 0;
  Monitor monitor;
  monitor.cancelled = [&] {
    ++polls;
    return false;
  };
  NoFunctions functions;
  Options options;
  const std::size_t first =
      plan(model.domain, model.problem, functions, {}, monitor, options).statistics.evaluated;
  const std::size_t to_first = polls;
  options.improvement_evaluations = 2000;
  polls = 0;
  const std::size_t in_all =
      plan(model.domain, model.problem, functions, {}, monitor, options).statistics.evaluated;
  EXPECT_GT(in_all, first + 200);
  EXPECT_GE((polls - to_first) * 16, in_all - first);
  for (const std::size_t more : {1, 20, 60}) {
    polls = 0;
    monitor.cancelled = [&] { return ++polls >= to_first + more; };
    EXPECT_EQ(plan(model.domain, model.problem, functions, {}, monitor, options).verdict, Verdict::cancelled);
    EXPECT_EQ(polls, to_first + more);
  }
}

TEST(Budget, CancellationAndProgress) {
  std::size_t reports = 0;
  Monitor monitor;
  monitor.progress = [&](const Statistics& statistics) {
    ++reports;
    EXPECT_GT(statistics.expanded, 0u);
  };
  monitor.cancelled = [&] { return reports == 2; };
  EXPECT_EQ(plan_with({}, monitor).verdict, Verdict::cancelled);
}

TEST(Budget, SameCallSameAnswer) {
  const auto model = testing::model(R"((:requirements :typing :durative-actions)
    (:types t) (:predicates (p ?x - t) (q ?x - t))
    (:durative-action a :parameters (?x - t) :duration (= ?duration 2) :condition (at start (q ?x))
      :effect (and (at start (not (q ?x))) (at end (p ?x)) (at end (q ?x)))))",
                                    "(:objects a b c d e - t) (:init (q a) (q b) (q c) (q d) (q e))"
                                    "(:goal (and (p a) (p b) (p c) (p d) (p e)))");
  for (const std::uint64_t seed : {0u, 1u, 2u}) {
    Options options;
    options.seed = seed;
    const Result first = testing::solved(model, options);
    const Result second = testing::solved(model, options);
    ASSERT_TRUE(first.plan);
    EXPECT_EQ(to_ipc(*first.plan), to_ipc(*second.plan));
    EXPECT_EQ(first.statistics.generated, second.statistics.generated);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
