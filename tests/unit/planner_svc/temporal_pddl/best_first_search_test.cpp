// What leads best-first search out of where its estimate stays.
#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options;
using search::BestFirstSearch;

// A key at the other end of a corridor opens a door at this one: the way there and the way back are together
// always as long. From everywhere lamps can be switched, and with all of them lit one can jump to the key,
// which takes more than to walk.
testing::Model fetch(int rooms) {
  std::string objects, init, lamps, lit;
  for (int i = 0; i < rooms; ++i) {
    const std::string here = " r" + std::to_string(i), there = " r" + std::to_string(i - 1);
    const std::string lamp = " l" + std::to_string(i);
    objects += here;
    if (i > 0) init += " (next" + here + there + ") (next" + there + here + ")";
    lamps += lamp;
    lit += " (at start (lit" + lamp + "))";
    init += " (off" + lamp + ")";
  }
  const std::string last = " r" + std::to_string(rooms - 1);
  return testing::model(
      "(:requirements :durative-actions) (:constants" + lamps + ")" + R"(
    (:predicates (at ?r) (next ?a ?b) (off ?l) (lit ?l) (lies ?r) (carried) (door ?r) (open))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (and (at start (at ?a)) (over all (next ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b))))
    (:durative-action take :parameters (?r) :duration (= ?duration 1)
      :condition (and (over all (at ?r)) (at start (lies ?r)))
      :effect (and (at start (not (lies ?r))) (at end (carried))))
    (:durative-action unlock :parameters (?r) :duration (= ?duration 1)
      :condition (and (over all (at ?r)) (over all (door ?r)) (at start (carried))) :effect (at end (open)))
    (:durative-action on :parameters (?l) :duration (= ?duration 1)
      :condition (at start (off ?l)) :effect (and (at start (not (off ?l))) (at end (lit ?l))))
    (:durative-action away :parameters (?l) :duration (= ?duration 1)
      :condition (at start (lit ?l)) :effect (and (at start (not (lit ?l))) (at end (off ?l))))
    (:durative-action jump :parameters (?a ?b) :duration (= ?duration 1)
      :condition (and (at start (at ?a)) (at start (lies ?b)))" +
          lit + ")" + R"(
      :effect (and (at start (not (at ?a))) (at end (at ?b)))))",
      "(:objects" + objects + ") (:init (at r0) (door r0) (lies" + last + ")" + init + ") (:goal (open))");
}

std::size_t evaluations(const testing::Model& model, const Options& options) {
  const Result result = testing::solved(model, options);
  testing::expect_valid(model, result);
  return result.statistics.evaluated;
}

TEST(BestFirstSearch, NoveltyLeadsAcrossPlateaus) {
  Options without;
  without.preferred_operators = without.landmarks = without.lookahead = without.best_first_width =
      without.goal_serialization = without.novelty = false;
  Options with = without;
  with.novelty = true;
  const testing::Model model = fetch(8);
  EXPECT_LT(3 * evaluations(model, with), evaluations(model, without));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
