// What can follow a stored state.
#include "planner_svc/temporal_pddl/search/state_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using search::NodeId, search::Rejection, search::StateSpace, search::Successor;
using task::ActionCompression, task::Task;
using temporal::Duration;

TEST(StateSpace, NothingStartsWhoseInvariantFailsUnlessTheStartBringsIt) {
  const Task task = testing::grounded(testing::model(R"((:requirements :durative-actions)
    (:predicates (light) (own) (g) (h))
    (:durative-action strike :parameters () :duration (= ?duration 5)
      :condition () :effect (and (at start (light)) (at end (not (light)))))
    (:durative-action mend :parameters () :duration (= ?duration 2)
      :condition (over all (light)) :effect (at end (g)))
    (:durative-action glow :parameters () :duration (= ?duration 2)
      :condition (over all (own)) :effect (and (at start (own)) (at end (not (own))) (at end (h)))))",
                                                     "(:init) (:goal (and (g) (h)))"))
                        .task;
  const auto start = [&](const char* name) { return task.actions[testing::action(task, name)].start; };
  StateSpace space(task, Duration(1000), ActionCompression::where_safe);
  Successor at_first, lit;
  at_first.state = task.initial_state;
  space.add(NodeId(), at_first);
  EXPECT_THAT(space.applicable(at_first.prefix),
              ::testing::UnorderedElementsAre(start("(strike)"), start("(glow)")));
  ASSERT_EQ(space.build(at_first.prefix, start("(strike)"), lit), Rejection::none);
  space.add(at_first.prefix.node, lit);
  EXPECT_THAT(space.applicable(lit.prefix), ::testing::IsSupersetOf({start("(mend)"), start("(glow)")}));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
