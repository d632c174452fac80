// Following relaxed plans: in which order their steps are taken, and what it saves.
#include "planner_svc/temporal_pddl/search/lookahead.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options;
using search::Lookahead, search::NodeId, search::PlanPrefix, search::StateSpace, search::Successor;
using task::ActionCompression, task::SnapId, task::SnapKind, task::Task;
using temporal::Duration;
using ::testing::ElementsAre;

// A match gives light for 5 s, in which a fuse can be mended; (burn) needs what only (never) brings.
testing::Model cellar() {
  return testing::model(R"((:requirements :durative-actions)
    (:predicates (unused) (light) (mended) (dark) (gone))
    (:durative-action strike :parameters () :duration (= ?duration 5)
      :condition (at start (unused))
      :effect (and (at start (not (unused))) (at start (light)) (at end (not (light))) (at end (dark))))
    (:durative-action mend :parameters () :duration (= ?duration 2)
      :condition (over all (light)) :effect (at end (mended)))
    (:durative-action leave :parameters () :duration (= ?duration 1)
      :condition (at start (dark)) :effect (at end (gone))))",
                        "(:init (unused)) (:goal (and (mended) (gone)))");
}

class LookaheadTest : public ::testing::Test {
 protected:
  LookaheadTest()
      : task_(testing::grounded(cellar()).task),
        space_(task_, Duration(1000), ActionCompression::where_safe) {
    first_.state = task_.initial_state;
    space_.add(NodeId(), first_);
  }
  SnapId start(const char* name) { return task_.actions[testing::action(task_, name)].start; }
  SnapId end(const char* name) { return task_.actions[testing::action(task_, name)].end; }

  Task task_;
  StateSpace space_;
  Successor first_, last_;
};

TEST_F(LookaheadTest, TakesWhatItCanInAnyOrderAndEndsOnlyWhereNothingStarts) {
  Lookahead lookahead(task_, space_);
  ASSERT_TRUE(lookahead.follow(
      first_.prefix,
      std::vector{start("(leave)"), end("(strike)"), end("(mend)"), start("(mend)"), start("(strike)")}, true,
      last_));
  // strike cannot end while mend needs its light; leave ends with its start: nothing can come between
  EXPECT_THAT(last_.prefix.steps, ElementsAre(start("(strike)"), start("(mend)"), end("(mend)"),
                                              end("(strike)"), start("(leave)"), end("(leave)")));
  EXPECT_TRUE(task_.layout.holds(last_.state, testing::fact(task_, "(gone)")));
  PlanPrefix again;
  space_.restore(last_.prefix.node, again);
  EXPECT_EQ(again.steps, last_.prefix.steps);
}

TEST_F(LookaheadTest, LeavesEverythingAsItIsWhereNothingCanBeTaken) {
  Lookahead lookahead(task_, space_);
  EXPECT_FALSE(lookahead.follow(first_.prefix, std::vector{start("(leave)"), end("(mend)")}, true, last_));
  EXPECT_EQ(space_.store().size(), 1u);
}

TEST(LookaheadOrder, WhoeverLeavesAPlaceHasDoneWhatWasToBeDoneThere) {
  const testing::Model room = testing::model(R"((:requirements :durative-actions)
    (:predicates (here) (there) (brush) (painted) (rested))
    (:durative-action leave :parameters () :duration (= ?duration 1)
      :condition (at start (here)) :effect (and (at start (not (here))) (at end (there))))
    (:durative-action paint :parameters () :duration (= ?duration 1)
      :condition (and (over all (here)) (at start (brush))) :effect (at end (painted)))
    (:durative-action fetch :parameters () :duration (= ?duration 1)
      :condition (over all (here)) :effect (at end (brush)))
    (:durative-action rest :parameters () :duration (= ?duration 1)
      :condition (over all (there)) :effect (at end (rested))))",
                                             "(:init (here)) (:goal (and (painted) (rested)))");
  const Task task = testing::grounded(room).task;
  StateSpace space(task, Duration(1000), ActionCompression::always);
  Successor first, last;
  first.state = task.initial_state;
  space.add(NodeId(), first);
  const auto start = [&](const char* name) { return task.actions[testing::action(task, name)].start; };
  Lookahead lookahead(task, space);
  const auto taken = [&](bool careful) {
    const std::vector plan{start("(leave)"), start("(rest)"), start("(paint)"), start("(fetch)")};
    EXPECT_TRUE(lookahead.follow(first.prefix, plan, careful, last));
    std::vector<SnapId> starts;
    std::ranges::copy_if(last.prefix.steps, std::back_inserter(starts),
                         [&](SnapId snap) { return task.snaps[snap].kind == SnapKind::start; });
    return starts;
  };
  EXPECT_THAT(taken(true),
              ElementsAre(start("(fetch)"), start("(paint)"), start("(leave)"), start("(rest)")));
  EXPECT_THAT(taken(false), ElementsAre(start("(leave)"), start("(rest)")));
}

TEST(LookaheadSearch, GoesAllTheWayWithOneEvaluation) {
  constexpr int kRooms = 50;
  std::string objects, next;
  for (int i = 0; i < kRooms; ++i) {
    objects += " r" + std::to_string(i);
    if (i > 0) next += " (next r" + std::to_string(i - 1) + " r" + std::to_string(i) + ")";
  }
  const testing::Model made = testing::model(R"((:requirements :durative-actions)
    (:predicates (at ?r) (next ?a ?b))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (and (at start (at ?a)) (over all (next ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b)))))",
                                             "(:objects" + objects + ") (:init (at r0)" + next +
                                                 ") (:goal (at r" + std::to_string(kRooms - 1) + "))");
  Options step_by_step;
  step_by_step.lookahead = false;
  step_by_step.best_first_width = step_by_step.goal_serialization = false;
  const Result far = testing::solved(made);
  testing::expect_valid(made, far);
  EXPECT_EQ(far.statistics.evaluated, 1u);
  EXPECT_EQ(testing::solved(made, step_by_step).statistics.evaluated, kRooms - 1u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
