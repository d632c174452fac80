// R15 to R21 on a task whose relaxed plans are computed by hand:
//   a: 5 s, needs p, adds its own invariant q at its start, r at its end
//   b: 2 to 10 s, needs r, and w at its end; adds g there
//   c: 3 s, w holds while it runs
//   d: takes p away
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using heuristics::Estimate, heuristics::FfHeuristic;
using task::ActionId, task::SnapId, task::Task, task::Word;
using testing::action, testing::fact;
using ::testing::UnorderedElementsAre;

constexpr const char* kDomain = R"(
  (:requirements :durative-actions :duration-inequalities)
  (:predicates (p) (q) (r) (w) (g))
  (:durative-action a :parameters () :duration (= ?duration 5)
    :condition (and (at start (p)) (over all (q)))
    :effect (and (at start (q)) (at end (not (q))) (at end (r))))
  (:durative-action b :parameters () :duration (and (>= ?duration 2) (<= ?duration 10))
    :condition (and (at start (r)) (at end (w))) :effect (at end (g)))
  (:durative-action c :parameters () :duration (= ?duration 3)
    :condition () :effect (and (at start (w)) (at end (not (w)))))
  (:durative-action d :parameters () :duration (= ?duration 1)
    :condition () :effect (and (at start (not (p))) (at start (not (r)))))
)";

class Ff : public ::testing::Test {
 protected:
  Ff()
      : task_(testing::grounded(testing::model(kDomain, "(:init (p)) (:goal (g))")).task),
        heuristic_(task_),
        state_(task_.initial_state) {}

  void evaluate(const std::vector<std::string>& running) {
    std::vector<ActionId> actions;
    for (const auto& name : running) actions.push_back(action(task_, name));
    heuristic_.evaluate({state_, actions, 0, nullptr, {}, {}}, estimate_);
  }
  SnapId start(const char* name) { return task_.actions[action(task_, name)].start; }
  SnapId end(const char* name) { return task_.actions[action(task_, name)].end; }

  Task task_;
  FfHeuristic heuristic_;
  std::vector<Word> state_;
  Estimate estimate_;
};

TEST_F(Ff, InitialStateNeedsAllThree) {
  evaluate({});
  EXPECT_FALSE(estimate_.dead_end);
  EXPECT_EQ(estimate_.cost, 10'000'000);  // 5 + 2 (the least duration of b) + 3
  EXPECT_EQ(estimate_.steps, 6);          // three starts, three ends; c's end only because c was started
  EXPECT_THAT(estimate_.preferred, UnorderedElementsAre(start("(a)"), start("(c)")));
}

// R16: the start of b asks for s, which e brings about in 7 s; that of f brings its own invariant about.
TEST(FfInvariants, AStartAsksForThoseThatItDoesNotBringAbout) {
  constexpr const char* domain = R"(
    (:requirements :durative-actions)
    (:predicates (s) (t) (g) (h))
    (:durative-action e :parameters () :duration (= ?duration 7) :condition () :effect (at end (s)))
    (:durative-action b :parameters () :duration (= ?duration 2) :condition (over all (s)) :effect (at end (g)))
    (:durative-action f :parameters () :duration (= ?duration 1) :condition (over all (t))
      :effect (and (at start (t)) (at end (h))))
  )";
  const auto cost = [&](const char* goal) {
    const Task task = testing::grounded(testing::model(domain, std::string("(:init) (:goal ") + goal + ")")).task;
    FfHeuristic heuristic(task);
    Estimate estimate;
    const std::vector<Word> state = task.initial_state;
    heuristic.evaluate({state, {}, 0, nullptr, {}, {}}, estimate);
    return estimate.cost;
  };
  EXPECT_EQ(cost("(g)"), 9'000'000);
  EXPECT_EQ(cost("(h)"), 1'000'000);
}

TEST_F(Ff, ARunningActionOnlyHasToEnd) {
  task_.layout.add(state_, fact(task_, "(q)"));
  evaluate({"(a)"});
  EXPECT_EQ(estimate_.cost, 5'000'000);
  EXPECT_EQ(estimate_.steps, 5);
  EXPECT_THAT(estimate_.preferred, UnorderedElementsAre(end("(a)"), start("(c)")));
}

TEST_F(Ff, AnEndIsOutOfReachWithoutItsStart) {
  task_.layout.remove(state_, fact(task_, "(p)"));
  evaluate({});
  EXPECT_TRUE(estimate_.dead_end);
  evaluate({"(a)"});
  EXPECT_FALSE(estimate_.dead_end);
}

TEST_F(Ff, WithGoalsReachedRunningActionsStillCount) {
  task_.layout.add(state_, fact(task_, "(g)"));
  evaluate({});
  EXPECT_EQ(estimate_.steps, 0);
  evaluate({"(b)"});
  EXPECT_EQ(estimate_.steps, 3);  // b's end needs w, for which c starts and ends
  EXPECT_EQ(estimate_.cost, 3'000'000);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
