// A tour through windows: what the search must see early.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using temporal::Verdict;

// Places on a line, 10 s apart; each has something to see for 2 s in a window of its own.
testing::Model tour(const std::vector<std::pair<int, int>>& windows) {
  std::string objects, init = "(:init (at p0) (idle)", goal;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const std::string place = "p" + std::to_string(i);
    objects += " " + place;
    goal += " (seen " + place + ")";
    for (std::size_t j = 0; j < windows.size(); ++j) {
      const auto distance = 10 * (i > j ? i - j : j - i);
      init += " (= (far " + place + " p" + std::to_string(j) + ") " + std::to_string(distance) + ")";
    }
    init += " (at " + std::to_string(windows[i].first) + " (lit " + place + ")) (at " +
            std::to_string(windows[i].second) + " (not (lit " + place + ")))";
  }
  return testing::model(R"((:requirements :typing :durative-actions :timed-initial-literals) (:types place)
    (:predicates (at ?p - place) (lit ?p - place) (seen ?p - place) (idle)) (:functions (far ?a ?b - place))
    (:durative-action go :parameters (?a ?b - place) :duration (= ?duration (far ?a ?b))
      :condition (and (at start (at ?a)) (over all (idle)))
      :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action see :parameters (?p - place) :duration (= ?duration 2)
      :condition (and (at start (idle)) (over all (at ?p)) (over all (lit ?p)))
      :effect (and (at start (not (idle))) (at end (idle)) (at end (seen ?p)))))",
                        "(:objects" + objects + " - place)" + init + ") (:goal (and" + goal + "))");
}

// Windows that a random tour meets in time, with little to spare.
std::vector<std::pair<int, int>> met_by_a_tour(std::size_t places, std::mt19937_64& random) {
  std::vector<std::size_t> order(places);
  for (std::size_t i = 0; i < places; ++i) order[i] = i;
  std::ranges::shuffle(order, random);
  std::vector<std::pair<int, int>> result(places);
  int time = 1;
  std::size_t here = 0;
  for (const std::size_t place : order) {
    time += static_cast<int>(10 * (place > here ? place - here : here - place));
    result[place] = {time, time + 8};
    time += 3;
    here = place;
  }
  return result;
}

TEST(MissedWindows, ToursAreFoundWithFewEvaluations) {
  std::mt19937_64 random(21);
  for (int round = 0; round < 20; ++round) {
    const auto made = tour(met_by_a_tour(7, random));
    const Result result = testing::solved(made);
    testing::expect_valid(made, result);
    EXPECT_LT(result.statistics.evaluated, 300u);
  }
}

TEST(MissedWindows, ATooEarlyWindowIsProvedAtOnce) {
  const auto made = tour({{30, 34}, {60, 64}, {100, 104}, {10, 14}, {38, 42}, {120, 124}});
  const Result result = testing::solved(made);  // p3 is too far for its window
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_EQ(result.statistics.expanded, 0u);
  EXPECT_EQ(result.reason,
            "(seen p3) cannot be reached in time: (see p3) can start no sooner than 30.000 s, but must by "
            "12.000 s: 18.000 s too late");
}

TEST(Windows, OneThatEndsWhereTheNextBeginsHoldsAfterThatWhateverStandsFirst) {
  for (const char* changes : {"(at 3 (lit)) (at 3 (not (lit)))", "(at 3 (not (lit))) (at 3 (lit))"}) {
    const testing::Model made = testing::model(
        R"((:requirements :durative-actions :timed-initial-literals) (:predicates (lit) (seen))
    (:durative-action see :parameters () :duration (= ?duration 4)
      :condition (and (at start (lit)) (over all (lit))) :effect (at end (seen))))",
        std::string("(:init (lit) ") + changes + " (at 8 (not (lit)))) (:goal (seen))");
    const Result result = testing::solved(made);
    ASSERT_EQ(result.verdict, Verdict::solved) << changes << result.reason;
    testing::expect_valid(made, result);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
