// Numbers that plans can only use up: which they are, what is still needed of them, and what that spares the
// search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "planner_svc/temporal_pddl/dead_ends/consumption_bound.hpp"
#include "planner_svc/temporal_pddl/dead_ends/resource_dead_ends.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/task/consumable_resources.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget, call::Monitor, call::Options, call::SearchLimits;
using dead_ends::AtemporalAbstraction, dead_ends::ConsumptionBound, dead_ends::ResourceDeadEnds;
using task::Action, task::ActionCompression, task::ConsumableResource, task::FactId, task::Semantics,
    task::Task;
using task::find_consumable_resources;
using temporal::Verdict;
using testing::grounded, testing::model, testing::solved;

testing::Model using_up(const std::string& actions, const std::string& goal = "(done)") {
  return model(
      "(:requirements :durative-actions :numeric-fluents) (:predicates (done) (more)) (:functions (x) (y))" +
          actions,
      "(:init (= (x) 10) (= (y) 0)) (:goal (and " + goal + "))");
}

TEST(Resources, WhatConditionsKeepFromFallingOrRising) {
  const auto made = using_up(R"(
    (:durative-action a :parameters () :duration (= ?duration 3) :condition (at start (>= (x) 5))
      :effect (and (at start (decrease (x) 4)) (at end (done))))
    (:durative-action b :parameters () :duration (= ?duration 3)
      :condition (and (over all (>= (x) 6)) (at start (<= (y) 5)))
      :effect (and (at end (decrease (x) 2)) (at start (increase (y) ?duration)) (at end (more)))))",
                             "(done) (more)");
  const auto grounding = grounded(made);
  const Task& task = grounding.task;
  const auto resources = find_consumable_resources(task);
  ASSERT_EQ(resources.size(), 2u);
  const auto& [x, y] = std::pair(resources[0], resources[1]);
  const Action& a = task.actions[testing::action(task, "(a)")];
  const Action& b = task.actions[testing::action(task, "(b)")];
  EXPECT_EQ(x.sign, 1);
  EXPECT_EQ(x.floor, 1);  // a leaves no less, b leaves 4
  EXPECT_EQ(x.taken[a.start], 4);
  EXPECT_EQ(x.taken[b.start], 0);
  EXPECT_EQ(x.taken[b.end], 2);
  EXPECT_EQ(x.left(task, task.initial_state), 9);
  EXPECT_EQ(y.sign, -1);
  EXPECT_EQ(y.floor, -8);
  EXPECT_EQ(y.taken[b.start], 3);
}

TEST(Resources, NoneWhereSomethingGivesOrSetsOrTakesUnasked) {
  const std::string spends = R"(
    (:durative-action a :parameters () :duration (= ?duration 3) :condition (at start (>= (x) 5))
      :effect (and (at start (decrease (x) 4)) (at end (done)))) )";
  const auto resources = [](const testing::Model& made) {
    return find_consumable_resources(grounded(made).task).size();
  };
  EXPECT_EQ(resources(using_up(spends)), 1u);
  EXPECT_EQ(resources(using_up(spends + "(:action b :parameters () :effect (increase (x) 1))")), 0u);
  EXPECT_EQ(resources(using_up(spends + "(:action b :parameters () :effect (assign (x) 1))")), 0u);
  EXPECT_EQ(resources(using_up(spends + "(:action b :parameters () :effect (decrease (x) 1))")), 0u);
  EXPECT_EQ(resources(using_up(spends + "(:action b :parameters () :effect (decrease (x) 1))",
                               "(done) (>= (x) 2)")),
            1u);  // the goal keeps it up
}

// Places in a random plane; a robot must see some of them, and driving takes fuel.
struct Tour {
  std::vector<std::vector<int>> fuel;
  std::vector<std::size_t> places;  // to see

  explicit Tour(std::mt19937_64& random, std::size_t n) {
    std::vector<std::pair<int, int>> at;
    for (std::size_t i = 0; i < n; ++i) at.emplace_back(random() % 100, random() % 100);
    for (const auto& [ax, ay] : at) {
      auto& row = fuel.emplace_back();
      for (const auto& [bx, by] : at)
        row.push_back(static_cast<int>(std::hypot(ax - bx, ay - by)) + static_cast<int>(random() % 9));
    }
    for (std::size_t i = 1; i < n; ++i) places.push_back(i);
  }
  // By trying every order; ways over other places may be shorter.
  int shortest() const {
    auto best = fuel;
    for (std::size_t k = 0; k < best.size(); ++k) {
      for (auto& row : best) {
        for (std::size_t j = 0; j < row.size(); ++j) row[j] = std::min(row[j], row[k] + best[k][j]);
      }
    }
    auto order = places;
    int result = 1'000'000;
    do {
      int length = 0;
      std::size_t here = 0;
      for (const std::size_t place : order) length += best[std::exchange(here, place)][place];
      result = std::min(result, length);
    } while (std::ranges::next_permutation(order).found);
    return result;
  }
  testing::Model with_fuel(int amount) const {
    std::string objects, init, goal;
    for (std::size_t i = 0; i < fuel.size(); ++i) {
      const std::string place = "p" + std::to_string(i);
      objects += " " + place;
      if (i > 0) goal += " (seen " + place + ")";
      for (std::size_t j = 0; j < fuel.size(); ++j) {
        if (i != j)
          init += " (= (far " + place + " p" + std::to_string(j) + ") " + std::to_string(fuel[i][j]) + ")";
      }
    }
    return model(R"((:requirements :typing :durative-actions :numeric-fluents) (:types place)
      (:predicates (at ?p - place) (seen ?p - place)) (:functions (far ?a ?b - place) (fuel))
      (:durative-action go :parameters (?a ?b - place) :duration (= ?duration (far ?a ?b))
        :condition (and (at start (at ?a)) (at start (>= (fuel) (+ 7 (far ?a ?b)))))
        :effect (and (at start (not (at ?a))) (at start (decrease (fuel) (far ?a ?b))) (at end (at ?b))))
      (:durative-action see :parameters (?p - place) :duration (= ?duration 2)
        :condition (over all (at ?p)) :effect (at end (seen ?p))))",
                 "(:objects" + objects + " - place) (:init (at p0) (= (fuel) " + std::to_string(amount + 7) +
                     ")" + init + ") (:goal (and" + goal + "))");
  }
};

// Where plenty is left, the walk over all states would be for nothing.
TEST(Resources, NothingIsMeasuredBeforeOneIsHalfUsedUp) {
  std::mt19937_64 random(8);
  const Tour tour(random, 4);
  const auto grounding = grounded(tour.with_fuel(tour.fuel[0][1] * 3 / 2));
  const Task& task = grounding.task;
  const Budget budget;
  const Monitor monitor;
  SearchLimits limits(budget, monitor);
  ResourceDeadEnds within(task, 1, limits);
  const std::size_t before = within.bytes();
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(within.proves_dead_end(task.initial_state, {}, ActionCompression::where_safe));
  EXPECT_EQ(within.bytes(), before);
  auto state = task.initial_state;
  Semantics(task).apply(task.actions[testing::action(task, "(go p0 p1)")].start, 1, state);
  within.proves_dead_end(state, {}, ActionCompression::where_safe);
  EXPECT_GT(within.bytes(), before);
}

TEST(Resources, WhileItIsMeasuredTheBytesInUseAreTold) {
  std::mt19937_64 random(5);
  const Tour tour(random, 6);
  const auto grounding = grounded(tour.with_fuel(1000));
  const auto resources = find_consumable_resources(grounding.task);
  std::size_t most = 0;
  const auto need =
      ConsumptionBound::measure(grounding.task, AtemporalAbstraction(grounding.task, {}), resources.front(),
                                10000, [&](std::size_t bytes) { most = std::max(most, bytes); });
  ASSERT_TRUE(need);
  EXPECT_GT(most, need->bytes());
}

TEST(Resources, TheNeedIsThatOfTheBestOrder) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 20; ++round) {
    const Tour tour(random, 6);
    const auto grounding = grounded(tour.with_fuel(1000));
    const auto resources = find_consumable_resources(grounding.task);
    ASSERT_EQ(resources.size(), 1u);
    auto need = ConsumptionBound::measure(grounding.task, AtemporalAbstraction(grounding.task, {}),
                                          resources.front(), 10000, [](std::size_t) {});
    ASSERT_TRUE(need);
    EXPECT_EQ(need->at_first(), tour.shortest());
    EXPECT_EQ(need->of(grounding.task.initial_state, {}), tour.shortest());
  }
}

TEST(Resources, ALittleTooLittleIsProvedAndJustEnoughIsFound) {
  std::mt19937_64 random(6);
  Options options;
  options.resource_patience = 0;
  for (int round = 0; round < 10; ++round) {
    const Tour tour(random, 7);
    const auto enough = tour.with_fuel(tour.shortest());
    const Result found = solved(enough, options);
    testing::expect_valid(enough, found, options);
    EXPECT_LT(found.statistics.evaluated, 100u);
    const Result proved = solved(tour.with_fuel(tour.shortest() - 1), options);
    EXPECT_EQ(proved.verdict, Verdict::unsolvable);
    EXPECT_LE(proved.statistics.evaluated, 1u);
    EXPECT_EQ(proved.reason, "the goals take at least " + std::to_string(tour.shortest()) +
                                 " of (fuel), but only " + std::to_string(tour.shortest() - 1) +
                                 " may be used: it begins at " + std::to_string(tour.shortest() + 6) +
                                 ", and actions must not take it below 7");
  }
}

TEST(Resources, DerivedFactsAreLeftOut) {
  const auto made = model(R"(
    (:requirements :durative-actions :numeric-fluents :derived-predicates)
    (:predicates (p) (ready) (done)) (:functions (x))
    (:derived (ready) (p))
    (:durative-action make :parameters () :duration (= ?duration 1) :condition () :effect (at end (p)))
    (:durative-action spend :parameters () :duration (= ?duration 1)
      :condition (and (at start (ready)) (at start (>= (x) 1)))
      :effect (and (at start (decrease (x) 1)) (at end (done)))))",
                          "(:init (= (x) 1)) (:goal (done))");
  Options options;
  options.resource_patience = 0;
  testing::expect_valid(made, solved(made, options), options);
}

// Too many states for one table: some of the goals at a time.
TEST(Resources, HalfOfTheGoalsWhereAllAreTooMany) {
  std::mt19937_64 random(7);
  const Tour tour(random, 6);
  const auto grounding = grounded(tour.with_fuel(1000));
  const ConsumableResource resource = find_consumable_resources(grounding.task).front();
  const auto& goals = grounding.task.goals.front().facts;
  const auto all = [&](std::size_t states) {
    return ConsumptionBound::measure(grounding.task, AtemporalAbstraction(grounding.task, {}), resource,
                                     states, [](std::size_t) {});
  };
  const auto some = [&](std::span<const FactId> of) {
    return ConsumptionBound::measure(grounding.task, AtemporalAbstraction(grounding.task, of), resource, 1000,
                                     [](std::size_t) {});
  };
  EXPECT_FALSE(all(50));
  const auto whole = all(1000);
  const auto half = some(std::span(goals).first(2));
  ASSERT_TRUE(whole && half);
  EXPECT_LT(half->states(), whole->states() / 2);
  EXPECT_LT(half->at_first(), whole->at_first());
  EXPECT_GT(half->at_first(), 0);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
