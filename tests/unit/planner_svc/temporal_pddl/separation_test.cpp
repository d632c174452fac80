// R6: what an effect leaves as it is has been touched nevertheless.
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using testing::expect_valid;
using testing::model;
using testing::solved;

constexpr const char* kRequirements =
    "(:requirements :durative-actions :negative-preconditions :timed-initial-literals)"
    "(:predicates (p0) (p1) (p3) (p4))";

TEST(Separation, WhatAlwaysHoldsAndIsAdded) {
  const auto made = model(std::string(kRequirements) + R"(
    (:action a0 :parameters () :precondition (p4) :effect (p0))
    (:durative-action a1 :parameters () :duration (= ?duration 0) :condition ()
      :effect (and (at start (p3)) (at end (p4)))))",
                          "(:init (p4) (at 4 (not (p3)))) (:goal (and (p0) (p3)))");
  expect_valid(made, solved(made));
}

TEST(Separation, WhatNeverHoldsAndIsDeleted) {
  const auto made = model(std::string(kRequirements) + R"(
    (:action a0 :parameters () :precondition (not (p4)) :effect (p0))
    (:durative-action a1 :parameters () :duration (= ?duration 0) :condition ()
      :effect (and (at start (p3)) (at end (not (p4))))))",
                          "(:init (at 4 (not (p3)))) (:goal (and (p0) (p3)))");
  expect_valid(made, solved(made));
}

TEST(Separation, WhatIsAddedByTheClock) {
  const auto made = model(std::string(kRequirements) + R"(
    (:durative-action a0 :parameters () :duration (= ?duration 2) :condition (at end (p4)) :effect (at end (p0))))",
                          "(:init (p4) (at 2 (p4))) (:goal (p0))");
  expect_valid(made, solved(made));
}

TEST(Separation, WhatIsDeletedAndAddedAtOnce) {
  const auto made = model(std::string(kRequirements) + R"(
    (:durative-action a0 :parameters () :duration (= ?duration 1) :condition ()
      :effect (and (at start (p0)) (at end (not (p4))) (at end (p4)))))",
                          "(:init (at 1 (p4))) (:goal (and (p0) (p4)))");
  expect_valid(made, solved(made));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
