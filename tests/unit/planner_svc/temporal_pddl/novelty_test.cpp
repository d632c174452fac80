// How many facts of a state are new, by hand.
#include "planner_svc/temporal_pddl/search/novelty.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using search::Novelty;
using task::ActionId;
using task::Task;
using task::Word;

TEST(Novelty, CountsFactsAndRunningActionsThatNoStateSoNearTheGoalHad) {
  const Task task = testing::grounded(testing::model(R"((:requirements :durative-actions)
    (:predicates (p) (q) (g))
    (:durative-action a :parameters () :duration (= ?duration 2)
      :condition (at start (p)) :effect (and (at start (not (p))) (at end (q))))
    (:durative-action b :parameters () :duration (= ?duration 2)
      :condition (at start (q)) :effect (at end (g))))",
                                                     "(:init (p)) (:goal (g))"))
                        .task;
  std::vector<Word> state = task.initial_state;
  const std::vector<ActionId> nothing, a{testing::action(task, "(a)")};
  Novelty novelty(task);
  EXPECT_EQ(novelty.see(state, nothing, 4), 1);  // p
  EXPECT_EQ(novelty.see(state, nothing, 4), 0);
  EXPECT_EQ(novelty.see(state, a, 5), 1);  // a running, but not p: it was nearer before
  EXPECT_EQ(novelty.see(state, a, 3), 2);
  task.layout.remove(state, testing::fact(task, "(p)"));
  task.layout.add(state, testing::fact(task, "(q)"));
  EXPECT_EQ(novelty.see(state, a, 3), 1);  // q
  EXPECT_EQ(novelty.see(state, nothing, 9), 0);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
