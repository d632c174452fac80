// Landmarks of a task by hand, and of random ones: every plan makes each of them true.
#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/heuristics/landmark_count.hpp"
#include "planner_svc/temporal_pddl/search/best_first_search.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using dead_ends::DeadEndDetectors;
using call::Budget, call::Monitor, call::Options, call::PlanningFailure, call::SearchLimits, call::Statistics;
using heuristics::Estimate, heuristics::FfHeuristic, heuristics::Landmark, heuristics::LandmarkCount,
    heuristics::LandmarkId, heuristics::PropositionId, heuristics::RelaxedTask;
using search::BestFirstSearch, search::SearchStyle;
using task::Action, task::FactId, task::Semantics, task::SnapId, task::Task;
using testing::fact;

constexpr const char* kCarts = R"(
    (:requirements :typing :durative-actions) (:types place cart)
    (:predicates (at ?c - cart ?p - place) (crate ?p - place) (on ?c - cart))
    (:durative-action drive :parameters (?c - cart ?a ?b - place) :duration (= ?duration 5)
      :condition (at start (at ?c ?a)) :effect (and (at start (not (at ?c ?a))) (at end (at ?c ?b))))
    (:durative-action load :parameters (?c - cart ?p - place) :duration (= ?duration 2)
      :condition (and (at start (crate ?p)) (over all (at ?c ?p)))
      :effect (and (at start (not (crate ?p))) (at end (on ?c))))
    (:durative-action unload :parameters (?c - cart ?p - place) :duration (= ?duration 2)
      :condition (and (at start (on ?c)) (over all (at ?c ?p)))
      :effect (and (at start (not (on ?c))) (at end (crate ?p)))))";

// A crate has to get from a to c by one of two carts; cart2 is at b.
const testing::Model& carts() {
  static const testing::Model made = testing::model(kCarts, R"((:objects cart1 cart2 - cart a b c - place)
    (:init (at cart1 b) (at cart2 b) (crate a)) (:goal (crate c)))");
  return made;
}

class Landmarks : public ::testing::Test {
 protected:
  Landmarks() : task_(testing::grounded(carts()).task), ff_(task_), count_(task_, ff_, limits_) {}

  LandmarkId of(const std::vector<std::string>& facts) const {
    std::vector<PropositionId> any_of;
    for (const auto& name : facts) any_of.push_back(ff_.relaxed().proposition(fact(task_, name.c_str())));
    std::ranges::sort(any_of);
    for (std::size_t i = 0; i < count_.landmarks().size(); ++i) {
      if (count_.landmarks()[LandmarkId(i)].any_of == any_of) return LandmarkId(i);
    }
    return LandmarkId();
  }
  bool ordered(LandmarkId earlier, LandmarkId later) const {
    const auto& after = count_.landmarks()[later].after;
    return std::ranges::any_of(after, [&](LandmarkId id) { return id == earlier || ordered(earlier, id); });
  }

  Budget budget_;
  Monitor monitor_;
  SearchLimits limits_{budget_, monitor_};
  Task task_;
  FfHeuristic ff_;
  LandmarkCount count_;
};

TEST_F(Landmarks, FactsAndAlternativesInOrder) {
  const LandmarkId there = of({"(at cart1 a)", "(at cart2 a)"});
  const LandmarkId loaded = of({"(on cart1)", "(on cart2)"});
  const LandmarkId goal = of({"(crate c)"});
  ASSERT_FALSE(there.is_none() || loaded.is_none() || goal.is_none());
  EXPECT_TRUE(count_.landmarks()[goal].goal);
  EXPECT_TRUE(ordered(there, loaded));
  EXPECT_TRUE(ordered(loaded, goal));
  EXPECT_TRUE(count_.landmarks()[of({"(crate a)"})].initially);
}

TEST_F(Landmarks, TheCountFallsAlongAPlanAndPrefersWhatComesNext) {
  const auto starts = [&](const char* name) { return task_.actions[testing::action(task_, name)].start; };
  const auto ends = [&](const char* name) { return task_.actions[testing::action(task_, name)].end; };
  std::vector<SnapId> steps;
  auto state = task_.initial_state;
  const Semantics semantics(task_);
  Estimate estimate;
  std::int64_t before = std::numeric_limits<std::int64_t>::max();
  for (const char* name :
       {"", "(drive cart2 b a)", "(load cart2 a)", "(drive cart2 a c)", "(unload cart2 c)"}) {
    if (*name != 0) {
      for (const SnapId step : {starts(name), ends(name)}) {
        steps.push_back(step);
        semantics.apply(step, 0, state);
      }
    }
    count_.evaluate({state, {}, 0, nullptr, {}, steps}, estimate);
    EXPECT_LT(estimate.landmarks, before) << name;
    before = estimate.landmarks;
    if (*name == 0) {
      EXPECT_THAT(estimate.preferred, ::testing::Contains(starts("(drive cart2 b a)")));
    }
  }
  EXPECT_EQ(before, 0);
}

// How many landmarks are to come when this has been done.
std::int64_t open_after(const testing::Model& model, const std::vector<std::string>& actions) {
  const Task task = testing::grounded(model).task;
  FfHeuristic ff(task);
  Budget budget;
  Monitor monitor;
  const SearchLimits limits(budget, monitor);
  LandmarkCount count(task, ff, limits);
  const Semantics semantics(task);
  std::vector<SnapId> steps;
  auto state = task.initial_state;
  for (const std::string& name : actions) {
    const Action& action = task.actions[testing::action(task, name)];
    for (const SnapId step : {action.start, action.end}) {
      steps.push_back(step);
      semantics.apply(step, 0, state);
    }
  }
  Estimate estimate;
  count.evaluate({state, {}, 0, nullptr, {}, steps}, estimate);
  return estimate.landmarks;
}

// Who paints gets dirty; so to be clean is still to come although it holds at first.
TEST(LandmarkOrder, AGoalThatMustBeUndoneComesLast) {
  const auto painter = [](const std::string& goal) {
    return testing::model(R"((:requirements :durative-actions) (:predicates (clean) (dirty) (painted))
    (:durative-action paint :parameters () :duration (= ?duration 5)
      :effect (and (at start (not (clean))) (at start (dirty)) (at end (painted))))
    (:durative-action wash :parameters () :duration (= ?duration 2)
      :condition (at start (dirty)) :effect (and (at start (not (dirty))) (at end (clean)))))",
                          "(:init (clean)) (:goal " + goal + ")");
  };
  EXPECT_EQ(open_after(painter("(and (painted) (clean))"), {}), open_after(painter("(painted)"), {}) + 1);
  EXPECT_EQ(open_after(painter("(and (painted) (clean))"), {"(paint)"}), 1);
  EXPECT_EQ(open_after(painter("(and (painted) (clean))"), {"(paint)", "(wash)"}), 0);
}

TEST(LandmarkCountAlongAPlan, GoalsThatAreLostAreToComeAgain) {
  const testing::Model one_cart = testing::model(kCarts, R"((:objects cart1 - cart a b c - place)
    (:init (at cart1 b) (crate a)) (:goal (and (crate c) (at cart1 b))))");
  const std::vector<std::string> brought{"(drive cart1 b a)", "(load cart1 a)", "(drive cart1 a c)",
                                         "(unload cart1 c)"};
  EXPECT_EQ(open_after(one_cart, brought), 1);
  auto home = brought;
  home.push_back("(drive cart1 c b)");
  EXPECT_EQ(open_after(one_cart, home), 0);
  home.push_back("(drive cart1 b a)");
  EXPECT_EQ(open_after(one_cart, home), 1);
}

TEST(LandmarksOfRandomTasks, EveryPlanMakesEachTrue) {
  std::mt19937_64 random(5);
  std::size_t checked = 0;
  for (int round = 0; round < 600; ++round) {
    Task task;
    try {
      task = testing::grounded(testing::random_task(random)).task;
    } catch (const PlanningFailure&) {
      continue;  // proved unsolvable
    }
    Budget budget;
    Monitor monitor;
    SearchLimits limits(budget, monitor);
    FfHeuristic ff(task);
    const LandmarkCount count(task, ff, limits);
    Statistics statistics;
    Options options;
    DeadEndDetectors detectors;
    BestFirstSearch search({task, options, limits, statistics}, {ff, detectors}, SearchStyle{});
    const auto outcome = search.run(500, 0);
    if (!outcome || !outcome->plan) continue;
    std::vector<bool> held(ff.relaxed().propositions(), false);
    RelaxedTask::each_fact(task, task.initial_state,
                           [&](FactId f) { held[ff.relaxed().proposition(f).index()] = true; });
    for (const SnapId step : outcome->plan->steps) {
      for (const PropositionId added : ff.relaxed().adds(step)) held[added.index()] = true;
    }
    for (const Landmark& landmark : count.landmarks()) {
      EXPECT_TRUE(std::ranges::any_of(landmark.any_of, [&](PropositionId p) { return held[p.index()]; }));
      checked += !landmark.initially;
    }
  }
  EXPECT_GT(checked, 100u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
