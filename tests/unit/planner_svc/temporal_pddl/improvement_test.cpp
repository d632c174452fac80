#include "planner_svc/temporal_pddl/improvement/improvement.hpp"

#include <gtest/gtest.h>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/improvement/action_elimination.hpp"
#include "planner_svc/temporal_pddl/improvement/large_neighbourhood_search.hpp"
#include "planner_svc/temporal_pddl/improvement/relaxed_schedule.hpp"
#include "tests/unit/planner_svc/temporal_pddl/brute_force.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {

using engine::NoFunctions;

namespace {

using call::Budget, call::Monitor, call::Options, call::SearchLimits, call::Statistics;
using constraints::ReleaseTimes;
using dead_ends::DeadEndDetectors;
using extraction::Activity;
using extraction::to_ipc;
using heuristics::FfHeuristic;
using improvement::eliminate_useless_actions;
using improvement::LargeNeighbourhoodSearch, improvement::PlanReplay, improvement::RelaxedSchedule;
using improvement::quality_of;
using search::Guide;
using task::Action, task::SnapId, task::Task, task::Word;
using temporal::Duration, temporal::Verdict, temporal::no_bound;

const testing::Model& roads() {
  static const testing::Model made = testing::model(R"(
    (:requirements :typing :durative-actions) (:types place)
    (:predicates (at ?p - place) (road ?a ?b - place) (seen ?p - place) (polished))
    (:functions (far ?a ?b - place))
    (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (far ?a ?b))
      :condition (and (at start (at ?a)) (at start (road ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action see :parameters (?p - place) :duration (= ?duration 2)
      :condition (over all (at ?p)) :effect (at end (seen ?p)))
    (:durative-action polish :parameters () :duration (= ?duration 1)
      :condition () :effect (at end (polished))))",
                                                    R"((:objects a b c - place)
    (:init (at a) (road a b) (road b a) (road b c) (road a c)
      (= (far a b) 5) (= (far b a) 5) (= (far b c) 5) (= (far a c) 7))
    (:goal (and (seen c) (at c) (polished))))");
  return made;
}

std::vector<SnapId> both_steps(const Task& task, std::initializer_list<const char*> names) {
  std::vector<SnapId> result;
  for (const char* name : names) {
    const Action& action = task.actions[testing::action(task, name)];
    result.push_back(action.start);
    result.push_back(action.end);
  }
  return result;
}

TEST(Elimination, DropsWhatServesNothingAndWhatDependsOnIt) {
  const Task task = testing::grounded(roads()).task;
  PlanReplay replay(task, Duration{1000});
  // there and back again, before the way to the goal
  const auto steps = both_steps(
      task, {"(drive a b)", "(see b)", "(drive b a)", "(polish)", "(drive a b)", "(drive b c)", "(see c)"});
  auto plan = replay.run(steps, {});
  ASSERT_TRUE(plan);
  Budget budget;
  Monitor monitor;
  SearchLimits limits(budget, monitor);
  eliminate_useless_actions(task, *plan, replay, 10'000, limits);
  EXPECT_EQ(plan->steps, both_steps(task, {"(polish)", "(drive a b)", "(drive b c)", "(see c)"}));
}

TEST(Elimination, KeepsToItsWork) {
  const Task task = testing::grounded(roads()).task;
  PlanReplay replay(task, Duration{1000});
  const auto steps = both_steps(task, {"(drive a b)", "(see b)", "(polish)", "(drive b c)", "(see c)"});
  auto plan = replay.run(steps, {});
  ASSERT_TRUE(plan);
  Budget budget;
  Monitor monitor;
  SearchLimits limits(budget, monitor);
  eliminate_useless_actions(task, *plan, replay, 0, limits);
  EXPECT_EQ(plan->steps, steps);
}

TEST(PlanReplay, NoPlanWithoutWhatIsNeeded) {
  const Task task = testing::grounded(roads()).task;
  PlanReplay replay(task, Duration{1000});
  const auto steps = both_steps(task, {"(polish)", "(drive a c)", "(see c)"});
  EXPECT_TRUE(replay.run(steps, {}));
  for (const std::uint32_t dropped : {0u, 2u, 4u}) EXPECT_FALSE(replay.run(steps, std::vector{dropped}));
}

// Two robots at the depot, four sites that each takes to visit ten seconds there and ten back.
const testing::Model& visits() {
  static const testing::Model made = testing::model(R"(
    (:requirements :typing :durative-actions) (:types robot site)
    (:predicates (home ?r - robot) (done ?s - site))
    (:durative-action visit :parameters (?r - robot ?s - site) :duration (= ?duration 20)
      :condition (at start (home ?r))
      :effect (and (at start (not (home ?r))) (at end (home ?r)) (at end (done ?s)))))",
                                                    R"((:objects r1 r2 - robot s1 s2 s3 s4 - site)
    (:init (home r1) (home r2)) (:goal (and (done s1) (done s2) (done s3) (done s4))))");
  return made;
}

TEST(RelaxedSchedule, SendsWhoIsFree) {
  const Task task = testing::grounded(visits()).task;
  PlanReplay replay(task, Duration{1000});
  const auto busy = replay.rest(both_steps(task, {"(visit r1 s1)", "(visit r1 s2)"}), {});
  ASSERT_TRUE(busy);
  ReleaseTimes release_times(task);
  release_times.measure(busy->steps, *replay.check().earliest(*busy));
  std::vector<Word> state = task.initial_state;
  for (const char* done : {"(done s1)", "(done s2)"}) task.layout.add(state, testing::fact(task, done));
  RelaxedSchedule finish(task);
  // r1 is back at 40.001 s only; r2 has been free all the time, for one after the other.
  EXPECT_EQ(finish.measure({state, {}, 0, &release_times, {}, busy->steps}), Duration{40'000'000});
  const auto start = [&](const char* name) { return task.actions[testing::action(task, name)].start; };
  EXPECT_EQ(std::vector(finish.preferred().begin(), finish.preferred().end()),
            (std::vector{start("(visit r2 s4)"), start("(visit r2 s3)")}));
  finish.limit(Duration{15'000'000});
  EXPECT_EQ(finish.measure({state, {}, 0, &release_times, {}, busy->steps}), no_bound);
}

TEST(LargeNeighbourhoodSearch, SharesOutWhatOneDoes) {
  const Task task = testing::grounded(visits()).task;
  PlanReplay replay(task, Duration{1000});
  auto plan =
      replay.run(both_steps(task, {"(visit r1 s1)", "(visit r1 s2)", "(visit r1 s3)", "(visit r1 s4)"}), {});
  ASSERT_TRUE(plan);
  Budget budget;
  Monitor monitor;
  SearchLimits limits(budget, monitor);
  Statistics statistics;
  FfHeuristic ff(task);
  DeadEndDetectors detectors;
  const std::vector<Guide> guides{{ff, detectors}};
  const Options options;
  LargeNeighbourhoodSearch neighbourhood({task, options, limits, statistics}, guides);
  Duration makespan = quality_of(task, *plan, replay.check()).makespan;
  EXPECT_EQ(makespan, Duration{80'003'000});
  for (int tries = 0; tries < 60; ++tries) {
    neighbourhood.vary(*plan, replay);
    const Duration now = quality_of(task, *plan, replay.check()).makespan;
    EXPECT_LE(now, makespan);
    makespan = now;
  }
  EXPECT_EQ(makespan, Duration{40'001'000});
}

// Brute force keeps apart what only adds the same fact.
constexpr Duration kTouching{10'000};

// What is found with three actions or fewer is never shorter than the best of these, and mostly as short.
TEST(Improvement, AgainstTheShortestPlansOfBruteForce) {
  std::mt19937_64 random(4);
  Options improved;
  improved.improvement_evaluations = 300;
  Budget budget;
  budget.evaluations = 1000;
  int solved = 0, best = 0, first_best = 0;
  for (int round = 0; round < 300; ++round) {
    const testing::Model model = testing::random_task(random);
    const Result first = testing::solved(model, {}, budget);
    if (first.verdict != Verdict::solved) continue;
    const Result result = testing::solved(model, improved, budget);
    testing::expect_valid(model, result, improved);
    EXPECT_LE(result.plan->makespan, first.plan->makespan);
    const auto shortest = testing::best_makespan(model, 3);
    if (!shortest) continue;
    if (result.plan->activities.size() <= 3) {
      EXPECT_GE(result.plan->makespan + kTouching, *shortest)
          << pddl::print(model.domain) + pddl::print(model.problem);
    }
    ++solved;
    best += result.plan->makespan <= *shortest;
    first_best += first.plan->makespan <= *shortest;
  }
  EXPECT_GT(solved, 50);
  EXPECT_GE(best, solved * 95 / 100) << solved << ", and of the first plans " << first_best;
  EXPECT_LT(first_best, best);
}

TEST(Improvement, FindsTheShortestWay) {
  Options options;
  options.improvement_evaluations = 200;
  const Result result = testing::solved(roads(), options);
  testing::expect_valid(roads(), result, options);
  EXPECT_EQ(result.plan->makespan, Duration{9'000'000});  // over a c; the invariant may touch the arrival
  EXPECT_EQ(result.plan->activities.size(), 3u);
}

Result solved_from(const testing::Model& model, const std::string& remaining) {
  NoFunctions functions;
  return plan(model.domain, model.problem, functions, {}, {}, {}, pddl::parse_plan(remaining, "remaining"));
}

TEST(WarmStart, WhatStillFitsTakesNoSearch) {
  const Result result =
      solved_from(roads(), "10: (drive a b) [5]\n10: (polish) [1]\n16: (drive b c) [5]\n22: (see c) [2]");
  testing::expect_valid(roads(), result);
  EXPECT_EQ(result.statistics.evaluated, 0u);
  EXPECT_EQ(result.plan->activities.size(), 4u);
}

TEST(WarmStart, WhatIsMissingIsFilledIn) {
  const Result result =
      solved_from(roads(), "0: (fly a c) [1]\n1: (drive b c) [5]\n2: (drive a b) [5]\n7: (see b) [2]");
  testing::expect_valid(roads(), result);
  EXPECT_GT(result.statistics.evaluated, 0u);
  // a b, then on: the steps that fit come first, though the way over b is the longer one
  EXPECT_EQ(result.plan->activities.front().arguments, (std::vector<std::string>{"a", "b"}));
}

// Whatever is said to remain, the verdict is that of a search, and plans are valid.
TEST(WarmStart, OnRandomTasksWithThePlansOfOthers) {
  std::mt19937_64 random(5);
  Budget budget;
  budget.evaluations = 1000;
  std::string remaining;
  int began_with_it = 0, compared = 0;
  for (int round = 0; round < 400; ++round) {
    const testing::Model model = testing::random_task(random);
    NoFunctions functions;
    const Result result = plan(model.domain, model.problem, functions, budget, {}, {},
                               pddl::parse_plan(remaining, "remaining"));
    const Result searched = testing::solved(model, {}, budget);
    if (result.plan) testing::expect_valid(model, result);
    if (searched.verdict != Verdict::timeout && result.verdict != Verdict::timeout) {
      ++compared;
      EXPECT_EQ(result.verdict, searched.verdict) << remaining << pddl::print(model.problem);
    }
    began_with_it += result.plan && result.statistics.evaluated < searched.statistics.evaluated;
    if (result.plan) remaining = to_ipc(*result.plan);
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(began_with_it, 5);
}

// As long a plan, whichever comes first; but the one need not wait for the other's window.
TEST(Improvement, WhatNeedNotWaitDoesNot) {
  const auto made = testing::model(R"(
    (:requirements :durative-actions :numeric-fluents :timed-initial-literals)
    (:predicates (open) (dug) (sent)) (:functions (battery))
    (:durative-action dig :parameters () :duration (= ?duration 5) :condition (at start (>= (battery) 1))
      :effect (and (at start (decrease (battery) 1)) (at end (dug))))
    (:durative-action send :parameters () :duration (= ?duration 20)
      :condition (and (over all (open)) (at start (>= (battery) 1)))
      :effect (and (at start (decrease (battery) 1)) (at end (sent)))))",
                                   "(:init (= (battery) 9) (at 100 (open))) (:goal (and (dug) (sent)))");
  NoFunctions functions;
  Options options;
  const auto remaining = pddl::parse_plan("100: (send) [20]\n101: (dig) [5]", "remaining");
  const auto digs_at = [&] {
    const Result result = plan(made.domain, made.problem, functions, {}, {}, options, remaining);
    testing::expect_valid(made, result);
    return std::ranges::find(result.plan->activities, "dig", &Activity::name)->start;
  };
  EXPECT_GE(digs_at(), std::chrono::seconds(100));
  options.improvement_evaluations = 100;
  EXPECT_EQ(digs_at(), std::chrono::seconds(0));
}

TEST(Improvement, ASpentBudgetKeepsThePlan) {
  bool solved = false;
  for (int limit = 1; limit < 60; ++limit) {
    Budget budget;
    int polls = 0;
    budget.out_of_time = [&] { return ++polls > limit; };
    Options options;
    options.improvement_evaluations = 1'000'000;
    const Verdict verdict = testing::solved(roads(), options, budget).verdict;
    EXPECT_EQ(verdict, solved || verdict == Verdict::solved ? Verdict::solved : Verdict::timeout);
    solved = verdict == Verdict::solved;
  }
  EXPECT_TRUE(solved);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
