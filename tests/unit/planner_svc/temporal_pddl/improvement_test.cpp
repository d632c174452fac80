#include "planner_svc/temporal_pddl/improvement/improvement.hpp"

#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/improvement/elimination.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

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
  Replay replay(task, Duration{1000});
  // there and back again, before the way to the goal
  const auto steps = both_steps(
      task, {"(drive a b)", "(see b)", "(drive b a)", "(polish)", "(drive a b)", "(drive b c)", "(see c)"});
  auto plan = replay.run(steps, {});
  ASSERT_TRUE(plan);
  Budget budget;
  Monitor monitor;
  Watch watch(budget, monitor);
  drop_useless_actions(task, *plan, replay, 10'000, watch);
  EXPECT_EQ(plan->steps, both_steps(task, {"(polish)", "(drive a b)", "(drive b c)", "(see c)"}));
}

TEST(Elimination, KeepsToItsWork) {
  const Task task = testing::grounded(roads()).task;
  Replay replay(task, Duration{1000});
  const auto steps = both_steps(task, {"(drive a b)", "(see b)", "(polish)", "(drive b c)", "(see c)"});
  auto plan = replay.run(steps, {});
  ASSERT_TRUE(plan);
  Budget budget;
  Monitor monitor;
  Watch watch(budget, monitor);
  drop_useless_actions(task, *plan, replay, 0, watch);
  EXPECT_EQ(plan->steps, steps);
}

TEST(Replay, NoPlanWithoutWhatIsNeeded) {
  const Task task = testing::grounded(roads()).task;
  Replay replay(task, Duration{1000});
  const auto steps = both_steps(task, {"(polish)", "(drive a c)", "(see c)"});
  EXPECT_TRUE(replay.run(steps, {}));
  for (const std::uint32_t dropped : {0u, 2u, 4u}) EXPECT_FALSE(replay.run(steps, std::vector{dropped}));
}

TEST(Improvement, FindsTheShortestWay) {
  Options options;
  options.improvement_evaluations = 200;
  const Result result = testing::solved(roads(), options);
  testing::expect_valid(roads(), result, options);
  EXPECT_EQ(result.plan->makespan, Duration{9'000'000});  // over a c; the invariant may touch the arrival
  EXPECT_EQ(result.plan->activities.size(), 3u);
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
