// Search goal by goal: which goal comes next, what it keeps, when it gives up.
#include "planner_svc/temporal_pddl/search/goal_serialization.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using dead_ends::DeadEndDetectors;
using call::Budget, call::Monitor, call::Options, call::SearchLimits, call::Statistics;
using heuristics::FfHeuristic;
using search::GoalSerialization, search::SearchOutcome;
using task::ActionCompression, task::SnapId, task::SnapKind, task::Task;
using temporal::Verdict;

// Boxes in places, closed; a crane carries them, one at a time and only while they are open. Each is to be
// where the next one is, and closed again. The last `spare` places are free.
testing::Model ring(int boxes, int spare) {
  std::string objects, init = "(at p0) (empty)", goal;
  for (int i = 0; i < boxes + spare; ++i) {
    const std::string place = " p" + std::to_string(i), box = " b" + std::to_string(i);
    objects += place;
    if (i >= boxes) {
      init += " (free" + place + ")";
      continue;
    }
    objects += box;
    init += " (in" + box + place + ") (closed" + box + ")";
    goal += " (in" + box + " p" + std::to_string((i + 1) % boxes) + ") (closed" + box + ")";
  }
  return testing::model(R"((:requirements :durative-actions)
    (:predicates (at ?p) (empty) (free ?p) (held ?b) (in ?b ?p) (closed ?b) (open ?b))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (at start (at ?a)) :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action unlock :parameters (?b) :duration (= ?duration 1)
      :condition (at start (closed ?b)) :effect (and (at start (not (closed ?b))) (at end (open ?b))))
    (:durative-action lock :parameters (?b ?p) :duration (= ?duration 1)
      :condition (and (at start (open ?b)) (over all (in ?b ?p)))
      :effect (and (at start (not (open ?b))) (at end (closed ?b))))
    (:durative-action take :parameters (?b ?p) :duration (= ?duration 1)
      :condition (and (at start (empty)) (over all (at ?p)) (over all (open ?b)) (at start (in ?b ?p)))
      :effect (and (at start (not (empty))) (at end (not (in ?b ?p))) (at end (free ?p)) (at end (held ?b))))
    (:durative-action put :parameters (?b ?p) :duration (= ?duration 1)
      :condition (and (at start (held ?b)) (over all (at ?p)) (at start (free ?p)))
      :effect (and (at start (not (free ?p))) (at end (not (held ?b))) (at end (empty)) (at end (in ?b ?p)))))",
                        "(:objects" + objects + ") (:init " + init + ") (:goal (and" + goal + "))");
}

class GoalSerializationTest : public ::testing::Test {
 protected:
  std::optional<SearchOutcome> run(const testing::Model& model, std::size_t turn, std::size_t turns) {
    task_ = testing::grounded(model).task;
    FfHeuristic ff(task_);
    SearchLimits limits(budget_, monitor_);
    statistics_ = {};
    GoalSerialization search({task_, options_, limits, statistics_}, {ff, detectors_}, ff,
                             ActionCompression::always);
    std::optional<SearchOutcome> outcome;
    while (!outcome && turns-- > 0) outcome = search.run(turn, 0);
    return outcome;
  }
  std::size_t steps(const SearchOutcome& outcome, const std::string& schema) const {
    return static_cast<std::size_t>(std::ranges::count_if(outcome.plan->steps, [&](SnapId snap) {
      return task_.snaps[snap].kind == SnapKind::start &&
             task_.schemas[task_.actions[task_.snaps[snap].action].schema.index()] == schema;
    }));
  }

  Budget budget_;
  Monitor monitor_;
  Options options_;
  Statistics statistics_;
  DeadEndDetectors detectors_;
  Task task_;
};

// One box goes out of the way and comes back in the end; the others go right to where they belong.
TEST_F(GoalSerializationTest, TakesAFewEvaluationsAGoal) {
  const auto outcome = run(ring(12, 2), 1000, 1);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_LE(statistics_.evaluated, 24u * 3);
  EXPECT_LE(steps(*outcome, "take"), 14u);
}

// To lock a box is a goal within reach all the time, but it has to be open to be carried.
TEST_F(GoalSerializationTest, WaitsWithWhatWouldHaveToBeUndone) {
  const auto outcome = run(ring(12, 2), 1000, 1);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_EQ(steps(*outcome, "lock"), 12u);
}

TEST_F(GoalSerializationTest, GoesOnWhereItStopped) {
  const auto at_once = run(ring(8, 1), 1000, 1);
  const auto by_turns = run(ring(8, 1), 1, 1000);
  ASSERT_TRUE(at_once && at_once->plan && by_turns && by_turns->plan);
  EXPECT_EQ(at_once->plan->steps, by_turns->plan->steps);
}

TEST_F(GoalSerializationTest, EndsWhereNoGoalCanBeReachedAndKept) {
  const auto outcome = run(ring(8, 0), 10000, 1);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->plan);
  EXPECT_LE(statistics_.evaluated, 1u + 8 * 20);
}

TEST_F(GoalSerializationTest, KnowsWhenNothingIsToBeDone) {
  const auto outcome = run(testing::model("(:predicates (p))", "(:init (p)) (:goal (p))"), 1, 1);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_TRUE(outcome->plan->steps.empty());
}

TEST_F(GoalSerializationTest, ThePlanIsValid) {
  Options options;
  options.lookahead = options.best_first_width = false;  // so that nothing else finds one before
  for (const auto& model : {ring(3, 1), ring(9, 2)}) {
    const Result result = testing::solved(model, options);
    ASSERT_EQ(result.verdict, Verdict::solved);
    testing::expect_valid(model, result, options);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
