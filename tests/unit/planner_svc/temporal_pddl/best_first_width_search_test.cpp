// Search by novelty: what it asks the heuristic for, what it passes by, when it gives up.
#include "planner_svc/temporal_pddl/search/best_first_width_search.hpp"

#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using dead_ends::DeadEndDetectors;
using search::SearchContext;
using call::Budget, call::Monitor, call::Options, call::SearchLimits, call::Statistics;
using heuristics::FfHeuristic;
using search::BestFirstWidthSearch, search::SearchOutcome;
using task::ActionCompression, task::Task;

// A corridor with a lamp in each of its rooms, and so many more that can be switched from everywhere.
testing::Model lamps(int rooms, int more, const std::string& goal) {
  std::string objects, next;
  for (int i = 0; i < rooms; ++i) {
    objects += " r" + std::to_string(i);
    if (i > 0) next += " (next r" + std::to_string(i - 1) + " r" + std::to_string(i) + ")";
  }
  for (int i = 0; i < more; ++i) {
    objects += " l" + std::to_string(i);
    next += " (near l" + std::to_string(i) + ") (off l" + std::to_string(i) + ")";
  }
  return testing::model(R"((:requirements :durative-actions)
    (:predicates (at ?r) (next ?a ?b) (near ?l) (off ?l) (lit ?l))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (and (at start (at ?a)) (over all (next ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action light :parameters (?r) :duration (= ?duration 1)
      :condition (at start (at ?r)) :effect (at end (lit ?r)))
    (:durative-action on :parameters (?l) :duration (= ?duration 1)
      :condition (and (over all (near ?l)) (at start (off ?l)))
      :effect (and (at start (not (off ?l))) (at end (lit ?l))))
    (:durative-action away :parameters (?l) :duration (= ?duration 1)
      :condition (and (over all (near ?l)) (at start (lit ?l)))
      :effect (and (at start (not (lit ?l))) (at end (off ?l)))))",
                        "(:objects" + objects + ") (:init (at r0)" + next + ") (:goal " + goal + ")");
}

class BestFirstWidthSearchTest : public ::testing::Test {
 protected:
  std::optional<SearchOutcome> run(const testing::Model& model, std::size_t evaluations) {
    task_ = testing::grounded(model).task;
    FfHeuristic ff(task_);
    SearchLimits limits(budget_, monitor_);
    BestFirstWidthSearch search({task_, options_, limits, statistics_}, {ff, detectors_},
                                ActionCompression::where_safe);
    auto outcome = search.run(evaluations, 0);
    bytes_ = search.bytes();
    return outcome;
  }

  Budget budget_;
  Monitor monitor_;
  Options options_;
  Statistics statistics_;
  DeadEndDetectors detectors_;
  Task task_;
  std::size_t bytes_ = 0;
};

// At first, and with the first and the second lamp; the last one ends the search.
TEST_F(BestFirstWidthSearchTest, EvaluatesOnlyWhereMoreGoalsHold) {
  const auto outcome = run(lamps(9, 0, "(and (lit r2) (lit r5) (lit r8))"), 100);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_EQ(statistics_.evaluated, 3u);
  EXPECT_LT(statistics_.generated, 64u);
}

// 2¹⁴ ways to switch lamps that do not matter; breadth-first they are all tried before the end of the
// corridor.
TEST_F(BestFirstWidthSearchTest, PassesByWhatIsNewOnlyInCombination) {
  const auto outcome = run(lamps(16, 14, "(and (at r15) (off l0))"), 1000);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_LT(statistics_.evaluated, 80u);
}

TEST_F(BestFirstWidthSearchTest, GoesOnWhereItStopped) {
  task_ = testing::grounded(lamps(16, 14, "(and (at r15) (off l0))")).task;
  FfHeuristic ff(task_);
  SearchLimits limits(budget_, monitor_);
  const SearchContext context{task_, options_, limits, statistics_};
  BestFirstWidthSearch at_once(context, {ff, detectors_}, ActionCompression::where_safe);
  BestFirstWidthSearch by_turns(context, {ff, detectors_}, ActionCompression::where_safe);
  const auto expected = at_once.run(1000, 0);
  std::optional<SearchOutcome> outcome;
  int turns = 0;
  for (; !outcome && turns < 1000; ++turns) outcome = by_turns.run(1, 0);
  EXPECT_GT(turns, 2);
  ASSERT_TRUE(expected && expected->plan && outcome && outcome->plan);
  EXPECT_EQ(outcome->plan->steps, expected->plan->steps);
}

// Nobody comes back from the last room, which the relaxed plan does not see.
TEST_F(BestFirstWidthSearchTest, EndsWhereNothingIsNew) {
  const auto outcome = run(lamps(12, 16, "(and (at r10) (lit r11))"), 1'000'000);
  ASSERT_TRUE(outcome && !outcome->plan);
  EXPECT_GT(bytes_, std::size_t{512} << 10);
}

TEST_F(BestFirstWidthSearchTest, EndsWithAQuarterOfTheMemory) {
  budget_.memory_bytes = std::size_t{1} << 20;
  const auto outcome = run(lamps(12, 16, "(and (at r10) (lit r11))"), 1'000'000);
  ASSERT_TRUE(outcome && !outcome->plan);
  EXPECT_GT(bytes_, std::size_t{256} << 10);
  EXPECT_LT(bytes_, std::size_t{384} << 10);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
