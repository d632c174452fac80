#include "planner_svc/temporal_pddl/task/numeric_dominance.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using task::numeric_dominance;
using task::NumericDominance;
using task::Task;

TEST(NumberPreferences, FollowTheSignsOfUse) {
  const Task task = testing::grounded(testing::model(R"(
    (:requirements :durative-actions :numeric-fluents) (:predicates (g))
    (:functions (battery) (heat) (both) (measured) (feeds-battery) (feeds-heat) (level))
    (:durative-action a :parameters () :duration (= ?duration (+ 1 (measured)))
      :condition (and (at start (>= (battery) 5)) (over all (<= (heat) 9)) (at start (> (both) 1)) (at end (< (both) 9))
                      (at start (= (level) 0)))
      :effect (and (at start (decrease (battery) 1)) (at end (increase (battery) (feeds-battery)))
                   (at end (increase (heat) (* 2 (feeds-heat)))) (at end (increase (measured) 1)) (at end (g))))
    (:action b :parameters () :precondition ()
      :effect (and (increase (feeds-battery) 1) (increase (feeds-heat) 1) (increase (level) 1)
                   (increase (both) 1)  (increase (heat) 1)))
  )",
                                                     R"((:init (= (battery) 9) (= (heat) 0) (= (both) 5)
    (= (measured) 1) (= (feeds-battery) 0) (= (feeds-heat) 0) (= (level) 0)) (:goal (g)))"))
                        .task;
  const auto preferences = numeric_dominance(task);
  const auto of = [&](const char* name) { return preferences[testing::number(task, name)]; };
  EXPECT_EQ(of("(battery)"), NumericDominance::higher);
  EXPECT_EQ(of("(heat)"), NumericDominance::lower);
  EXPECT_EQ(of("(both)"), NumericDominance::exact);
  EXPECT_EQ(of("(measured)"), NumericDominance::exact);
  EXPECT_EQ(of("(level)"), NumericDominance::exact);
  EXPECT_EQ(of("(feeds-battery)"), NumericDominance::higher);
  EXPECT_EQ(of("(feeds-heat)"), NumericDominance::lower);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
