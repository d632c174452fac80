// A rover mission after Stellar, section 3.3: drives, science, transmission in recurring windows, external
// functions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {

using engine::FunctionOutcome;

namespace {

using temporal::Verdict;

constexpr const char* kDomain = R"(
  (:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals)
  (:types waypoint image sample)
  (:modules (:module paths (:function (drive-time ?a ?b - waypoint)) (:function (drive-energy ?a ?b - waypoint))))
  (:predicates (at ?w - waypoint) (stowed) (idle) (radio-free) (hand-free) (in-view ?i - image ?w - waypoint)
    (lit ?i - image) (taken ?i - image) (sent ?i - image) (lies ?s - sample ?w - waypoint) (held ?s - sample)
    (brought ?s - sample ?w - waypoint) (contact))
  (:functions (energy) (reserve))
  (:durative-action drive :parameters (?a ?b - waypoint) :duration (= ?duration (drive-time ?a ?b))
    :condition (and (at start (at ?a)) (over all (stowed)) (over all (idle))
                    (at start (>= (energy) (+ (reserve) (drive-energy ?a ?b)))))
    :effect (and (at start (not (at ?a))) (at start (decrease (energy) (drive-energy ?a ?b))) (at end (at ?b))))
  (:durative-action unstow :parameters () :duration (= ?duration 20) :condition (at start (stowed))
    :effect (at start (not (stowed))))
  (:durative-action stow :parameters () :duration (= ?duration 20) :condition () :effect (at end (stowed)))
  (:durative-action look :parameters (?i - image ?w - waypoint) :duration (= ?duration 40)
    :condition (and (at start (idle)) (at start (in-view ?i ?w)) (over all (at ?w)) (over all (lit ?i)))
    :effect (and (at start (not (idle))) (at start (decrease (energy) 5)) (at end (idle)) (at end (taken ?i))))
  (:durative-action pick :parameters (?s - sample ?w - waypoint) :duration (= ?duration 60)
    :condition (and (at start (lies ?s ?w)) (at start (hand-free)) (over all (at ?w)) (at start (not (stowed))))
    :effect (and (at start (not (hand-free))) (at start (decrease (energy) 9)) (at end (not (lies ?s ?w)))
                 (at end (held ?s))))
  (:durative-action put :parameters (?s - sample ?w - waypoint) :duration (= ?duration 30)
    :condition (and (at start (held ?s)) (over all (at ?w)) (at start (not (stowed))))
    :effect (and (at end (not (held ?s))) (at end (hand-free)) (at end (brought ?s ?w))))
  (:durative-action send :parameters (?i - image) :duration (= ?duration 120)
    :condition (and (at start (taken ?i)) (at start (radio-free)) (over all (contact)))
    :effect (and (at start (not (radio-free))) (at start (decrease (energy) 20)) (at end (radio-free))
                 (at end (sent ?i)))))";

struct Mission {
  int waypoints, images, samples, contacts;
  double energy = 5000;
};

testing::Model mission(const Mission& size, std::mt19937_64& random, testing::MapFunctions& functions) {
  std::string objects, init, goal;
  std::vector<std::pair<double, double>> places;
  const auto name = [](const char* kind, std::size_t i) { return kind + std::to_string(i); };
  const auto some_waypoint = [&] { return name("w", random() % static_cast<unsigned>(size.waypoints)); };
  for (int i = 0; i < size.waypoints; ++i) {
    objects += " " + name("w", static_cast<std::size_t>(i));
    places.emplace_back(random() % 200, random() % 200);
  }
  objects += " - waypoint";
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      const double metres =
          std::hypot(places[i].first - places[j].first, places[i].second - places[j].second);
      const std::string pair = " " + name("w", i) + " " + name("w", j) + ")";
      functions.set("(drive-time" + pair, metres / 0.15);
      functions.set("(drive-energy" + pair, metres * 0.8);
      if (i != j && random() % 10 == 0) functions.set("(drive-time" + pair, FunctionOutcome::unreachable);
    }
  }
  for (int i = 0; i < size.images; ++i) {
    const std::string image = name("i", static_cast<std::size_t>(i));
    objects += " " + image + " - image";
    init += " (lit " + image + ") (in-view " + image + " " + some_waypoint() + ")";
    goal += " (sent " + image + ")";
  }
  for (int i = 0; i < size.samples; ++i) {
    const std::string sample = name("s", static_cast<std::size_t>(i));
    objects += " " + sample + " - sample";
    init += " (lies " + sample + " " + some_waypoint() + ")";
    goal += " (brought " + sample + " " + some_waypoint() + ")";
  }
  for (int i = 0; i < size.contacts; ++i) {
    const int opens = 1500 + 3000 * i;
    init += " (at " + std::to_string(opens) + " (contact)) (at " + std::to_string(opens + 600) +
            " (not (contact)))";
  }
  return testing::model(kDomain, "(:objects" + objects +
                                     ") (:init (at w0) (stowed) (idle) (radio-free) (hand-free)" +
                                     "(= (reserve) 50) (= (energy) " + std::to_string(size.energy) + ")" +
                                     init + ") (:goal (and" + goal + "))");
}

TEST(Planetary, PlansWithFewEvaluations) {
  std::mt19937_64 random(12);
  std::size_t most = 0;
  for (const Mission& size :
       {Mission{5, 2, 1, 8}, {6, 3, 0, 8}, {8, 3, 2, 10}, {10, 4, 2, 16}, {12, 5, 3, 20}, {12, 8, 0, 20}}) {
    for (int round = 0; round < 5; ++round) {
      testing::MapFunctions functions;
      const auto made = mission(size, random, functions);
      const Result result = testing::solved(made, functions);
      testing::expect_valid(made, result);
      most = std::max(most, result.statistics.evaluated);
    }
  }
  EXPECT_LT(most, 1000u);
}

TEST(Planetary, SaysSoWhenTheEnergyIsTooLow) {
  std::mt19937_64 random(13);
  testing::MapFunctions functions;
  const auto made = mission({3, 1, 0, 2, 24}, random, functions);
  EXPECT_EQ(testing::solved(made, functions).verdict, Verdict::unsolvable);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
