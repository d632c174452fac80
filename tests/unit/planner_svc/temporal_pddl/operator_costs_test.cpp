// What relaxed plans make of goals that they would undo.
#include "planner_svc/temporal_pddl/heuristics/operator_costs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using heuristics::Estimate;
using heuristics::FfHeuristic;
using heuristics::OperatorCosts;
using task::SnapId;
using task::SnapKind;
using task::Task;
using ::testing::ElementsAre;

constexpr const char* kDomain = R"((:requirements :durative-actions)
    (:predicates (parked) (home) (half))
    (:durative-action drive :parameters () :duration (= ?duration 1)
      :condition () :effect (and (at start (not (parked))) (at end (home))))
    (:durative-action lurch :parameters () :duration (= ?duration 1)
      :condition () :effect (and (at start (not (parked))) (at end (parked)) (at end (half))))
    (:durative-action walk :parameters () :duration (= ?duration 1)
      :condition (at start (half)) :effect (at end (home))))";

struct Seen {
  std::int64_t steps;
  std::vector<std::string> actions;
};

// From the initial state.
Seen look(const char* problem, const char* domain = kDomain) {
  const Task task = testing::grounded(testing::model(domain, problem)).task;
  FfHeuristic heuristic(task);
  Estimate estimate;
  heuristic.evaluate({task.initial_state, {}, 0, nullptr, {}, {}}, estimate);
  Seen seen{estimate.steps, {}};
  for (const SnapId snap : estimate.relaxed_plan) {
    if (task.snaps[snap].kind == SnapKind::start) seen.actions.push_back(name(task, task.snaps[snap].action));
  }
  return seen;
}

TEST(OperatorCosts, AWayThatUndoesNoGoalIsTakenIfThereIsOne) {
  const Seen seen = look("(:init (parked)) (:goal (and (parked) (home)))");
  EXPECT_THAT(seen.actions, ElementsAre("(lurch)", "(walk)"));  // lurch restores what it takes
  EXPECT_EQ(seen.steps, 4);
}

TEST(OperatorCosts, WhatIsNoGoalMayBeUndone) {
  const Seen seen = look("(:init (parked)) (:goal (home))");
  EXPECT_THAT(seen.actions, ElementsAre("(drive)"));
  EXPECT_EQ(seen.steps, 2);
}

TEST(OperatorCosts, AGoalThatDoesNotHoldYetCannotBeUndone) {
  const Seen seen = look("(:init) (:goal (and (parked) (home)))");
  EXPECT_THAT(seen.actions, ::testing::UnorderedElementsAre("(lurch)", "(drive)"));
  EXPECT_EQ(seen.steps, 4);
}

TEST(OperatorCosts, OnlyGoalsOfEveryAlternativeCount) {
  const Seen seen = look("(:init (parked)) (:goal (or (and (parked) (home)) (and (half) (home))))");
  EXPECT_THAT(seen.actions, ElementsAre("(drive)"));
}

TEST(OperatorCosts, WhatCannotBeHelpedRaisesTheEstimate) {
  const Seen seen = look("(:init (lid)) (:goal (and (lid) (sweet)))", R"((:requirements :durative-actions)
    (:predicates (lid) (sweet))
    (:durative-action close :parameters () :duration (= ?duration 1) :condition () :effect (at end (lid)))
    (:durative-action open :parameters () :duration (= ?duration 1)
      :condition (at start (lid)) :effect (and (at end (not (lid))) (at end (sweet)))))");
  EXPECT_THAT(seen.actions, ElementsAre("(open)"));
  EXPECT_EQ(seen.steps, 2 + 2 * OperatorCosts::kGoalThreatPenalty);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
