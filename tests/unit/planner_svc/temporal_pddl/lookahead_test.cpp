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

// A way through 30 rooms, of which timed literals or values let only a part be gone before them.
testing::Model way(const std::string& condition, const std::string& duration, const std::string& timed) {
  std::string objects = "r0", next;
  for (int i = 1; i < 30; ++i) {
    objects += " r" + std::to_string(i);
    next += " (next r" + std::to_string(i - 1) + " r" + std::to_string(i) + ")";
  }
  return testing::model(
      "(:requirements :durative-actions :numeric-fluents :negative-preconditions :timed-initial-literals)"
      "(:predicates (at ?r) (next ?a ?b) (storm)) (:functions (wind))"
      "(:durative-action go :parameters (?a ?b) :duration (= ?duration " +
          duration + ") :condition (and (at start (at ?a)) (over all (next ?a ?b)) " + condition +
          ") :effect (and (at start (not (at ?a))) (at end (at ?b))))",
      "(:objects " + objects + ") (:init (at r0) (= (wind) 0)" + next + timed + ") (:goal (at r29))");
}

TEST(LookaheadSearch, GoesOnAfterTimedValuesThatItsStepsReadTooLateBefore) {
  const testing::Model made = way("", "(+ 2 (wind))", "(at 5 (= (wind) 2)) (at 21 (= (wind) 1))");
  const Result far = testing::solved(made);
  testing::expect_valid(made, far);
  EXPECT_EQ(far.statistics.evaluated, 1u);
}

TEST(LookaheadSearch, LeavesTimedLiteralsAloneThatHelpNoStart) {
  const Task task =
      testing::grounded(way("(over all (not (storm)))", "2", "(at 50 (storm)) (at 90 (not (storm)))")).task;
  StateSpace space(task, Duration(1000), ActionCompression::where_safe);
  Successor first, last;
  first.state = task.initial_state;
  space.add(NodeId(), first);
  const SnapId go = task.actions[testing::action(task, "(go r0 r1)")].start;
  const SnapId not_from_here = task.actions[testing::action(task, "(go r8 r9)")].start;
  ASSERT_TRUE(Lookahead(task, space).follow(first.prefix, std::vector{not_from_here, go}, true, last));
  EXPECT_EQ(last.prefix.timed_done, 0u);
  EXPECT_TRUE(task.layout.holds(last.state, testing::fact(task, "(at r1)")));
}

TEST(LookaheadSearch, GoesOnAfterTimedLiteralsThatItsStepsHaveToWaitFor) {
  const testing::Model made =
      way("(over all (not (storm)))", "2",
          "(at 5 (storm)) (at 9 (not (storm))) (at 30 (storm)) (at 35 (not (storm)))");
  const Result far = testing::solved(made);
  testing::expect_valid(made, far);
  EXPECT_EQ(far.statistics.evaluated, 1u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
