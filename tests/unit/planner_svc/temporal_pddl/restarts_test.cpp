// Other first plans: what differs from one to the next, what they may cost, when they are given up.
#include "planner_svc/temporal_pddl/improvement/restarts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using dead_ends::DeadEndDetectors;
using search::Guide;
using search::SearchContext;
using call::Budget, call::Monitor, call::Options, call::SearchLimits, call::Statistics;
using heuristics::FfHeuristic;
using improvement::Restarts;
using task::SnapId, task::Task;

// Someone who goes about and paints what is to be painted.
testing::Model rooms(const std::string& more, const std::string& goal) {
  return testing::model(R"((:requirements :durative-actions)
    (:predicates (at ?r) (paint) (painted ?r))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (at start (at ?a)) :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action colour :parameters (?r) :duration (= ?duration 1)
      :condition (and (over all (at ?r)) (at start (paint)))
      :effect (and (at end (painted ?r)))" +
                            more + "))",
                        "(:objects r0 r1 r2 r3 r4) (:init (at r0) (paint)) (:goal " + goal + ")");
}

class RestartsTest : public ::testing::Test {
 protected:
  RestartsTest() : limits_(budget_, monitor_) {}

  void prepare(const testing::Model& model) {
    task_ = testing::grounded(model).task;
    ff_.emplace(task_);
    starts_.emplace(SearchContext{task_, options_, limits_, statistics_}, Guide{*ff_, detectors_}, *ff_);
  }

  Budget budget_;
  Monitor monitor_;
  SearchLimits limits_;
  Options options_;
  Statistics statistics_;
  DeadEndDetectors detectors_;
  Task task_;
  std::optional<FfHeuristic> ff_;
  std::optional<Restarts> starts_;
};

TEST_F(RestartsTest, GoalsComeInAnotherOrderEachTime) {
  prepare(rooms("", "(and (painted r1) (painted r2) (painted r3) (painted r4))"));
  std::set<std::vector<SnapId>> plans;
  for (int i = 0; i < 20; ++i) {
    const auto outcome = starts_->next(100);
    ASSERT_TRUE(outcome.plan);
    plans.insert(outcome.plan->steps);
  }
  EXPECT_GT(plans.size(), 3u);
}

TEST_F(RestartsTest, ACostIsTold) {
  prepare(rooms("", "(and (painted r1) (painted r2) (painted r3))"));
  const auto cut_short = starts_->next(1);
  EXPECT_FALSE(cut_short.plan);
  EXPECT_EQ(cut_short.evaluations, 1u);
  EXPECT_TRUE(starts_->promising());
  const std::size_t before = statistics_.evaluated;
  const std::size_t told = starts_->next(100).evaluations;
  EXPECT_EQ(told, statistics_.evaluated - before);
}

// The paint is for one room.
TEST_F(RestartsTest, AreGivenUpWhereTheyLeadNowhere) {
  prepare(rooms("(at end (not (paint)))", "(and (painted r1) (painted r2))"));
  for (int i = 0; i < 20 && starts_->promising(); ++i) EXPECT_FALSE(starts_->next(100).plan);
  EXPECT_FALSE(starts_->promising());
}

TEST_F(RestartsTest, OneGoalLeavesNoChoice) {
  prepare(rooms("", "(painted r1)"));
  EXPECT_FALSE(starts_->promising());
}

// The budget is for the first plan.
TEST_F(RestartsTest, GoOnBeyondTheBudgetOfEvaluations) {
  budget_.evaluations = 1;
  prepare(rooms("", "(and (painted r1) (painted r2) (painted r3))"));
  EXPECT_ANY_THROW(starts_->next(100));
  limits_.first_plan_found();
  EXPECT_TRUE(starts_->next(100).plan);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
