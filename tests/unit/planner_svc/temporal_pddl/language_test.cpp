// The table of docs/pddl-support.md, row by row: a small problem each, planned and validated; and one that
// must have no plan, where a construct that is read too generously would give one.
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using temporal::Verdict;

struct Row {
  const char* name;
  const char* domain;
  const char* solvable;
  const char* unsolvable;
};

const Row kRows[] = {
    {"types_constants_equality", R"((:requirements :typing :equality) (:types place - object box bag - thing)
      (:constants hall - place)
      (:predicates (in ?t - (either box bag) ?p - place) (twins ?a ?b - thing))
      (:action bring :parameters (?t - (either box bag) ?p - place)
        :precondition (and (in ?t ?p) (not (= ?p hall))) :effect (and (not (in ?t ?p)) (in ?t hall)))
      (:action pair :parameters (?a ?b - (either box bag))
        :precondition (and (not (= ?a ?b)) (in ?a hall) (in ?b hall)) :effect (twins ?a ?b)))",
     "(:objects b - box c - bag shed - place) (:init (in b shed) (in c hall)) (:goal (twins c b))",
     "(:objects b - box c - bag shed - place) (:init (in b shed) (in c hall)) (:goal (twins c c))"},

    {"disjunctions_at_all_points", R"((:requirements :durative-actions :adl)
      (:predicates (a) (b) (c) (g))
      (:durative-action make-b :parameters () :duration (= ?duration 3)
        :condition (at start (a)) :effect (and (at start (b)) (at end (not (b)))))
      (:durative-action work :parameters () :duration (= ?duration 2)
        :condition (and (at start (or (b) (c))) (over all (or (b) (c))) (at end (or (c) (not (a)) (b))))
        :effect (at end (g))))",
     "(:init (a)) (:goal (g))", "(:init) (:goal (g))"},

    {"quantifiers", R"((:requirements :adl)
      (:predicates (clean ?x) (dirty ?x) (near ?x) (inspected))
      (:action wash :parameters (?x) :precondition (and (dirty ?x) (exists (?y) (and (near ?y) (clean ?y))))
        :effect (and (clean ?x) (not (dirty ?x))))
      (:action inspect :parameters () :precondition (forall (?x) (imply (near ?x) (and (clean ?x) (not (dirty ?x)))))
        :effect (inspected)))",
     "(:objects x y z) (:init (near x) (near y) (clean x) (dirty y) (dirty z)) (:goal (inspected))",
     "(:objects x y z) (:init (near x) (near y) (dirty x) (dirty y) (dirty z)) (:goal (inspected))"},

    {"conditional_effects", R"((:requirements :durative-actions :adl)
      (:predicates (loaded ?x) (wet ?x) (covered ?x) (arrived ?x) (raining))
      (:durative-action trip :parameters () :duration (= ?duration 5) :condition ()
        :effect (and (forall (?x) (when (at start (loaded ?x)) (at end (arrived ?x))))
                     (forall (?x) (when (at start (and (raining) (not (covered ?x)))) (at start (wet ?x))))))
      (:action cover :parameters (?x) :precondition () :effect (covered ?x))
      (:action load :parameters (?x) :precondition () :effect (loaded ?x)))",
     "(:objects p q) (:init (raining) (loaded q)) (:goal (and (arrived p) (not (wet p))))",
     "(:objects p q) (:init (raining) (covered p)) (:goal (and (wet p) (arrived p)))"},

    {"durations_of_the_state", R"((:requirements :durative-actions :duration-inequalities :numeric-fluents)
      (:predicates (spare) (ready) (g)) (:functions (speed) (time-left))
      (:durative-action tune :parameters () :duration (= ?duration 1)
        :condition (at start (spare))
        :effect (and (at start (not (spare))) (at end (increase (speed) 1)) (at end (decrease (time-left) 1))
                     (at end (ready))))
      (:durative-action run :parameters ()
        :duration (and (>= ?duration (- 9 (* 2 (speed)))) (<= ?duration (time-left)))
        :condition (over all (ready)) :effect (at end (g))))",
     "(:init (spare) (= (speed) 0) (= (time-left) 8)) (:goal (g))",
     "(:init (spare) (= (speed) 0) (= (time-left) 7)) (:goal (g))"},

    {"timed_values", R"((:requirements :durative-actions :timed-initial-literals :numeric-fluents)
      (:predicates (g)) (:functions (sun) (charge))
      (:durative-action work :parameters () :duration (= ?duration 4)
        :condition (and (at start (>= (sun) 5)) (over all (>= (sun) 2)))
        :effect (and (at end (g)))))",
     "(:init (= (sun) 0) (= (charge) 0) (at 10 (= (sun) 6)) (at 14.5 (= (sun) 1))) (:goal (g))",
     "(:init (= (sun) 0) (= (charge) 0) (at 10 (= (sun) 6)) (at 13.5 (= (sun) 1))) (:goal (g))"},

    {"timed_literals", R"((:requirements :durative-actions :timed-initial-literals)
      (:predicates (open) (g))
      (:durative-action pass :parameters () :duration (= ?duration 4)
        :condition (and (at start (open)) (at end (open))) :effect (at end (g))))",
     "(:init (at 3 (open)) (at 5 (not (open))) (at 6 (open)) (at 8 (not (open)))) (:goal (g))",
     "(:init (at 3 (open)) (at 5 (not (open))) (at 10 (open)) (at 12 (not (open)))) (:goal (g))"},

    {"duration_in_effects", R"((:requirements :durative-actions :numeric-fluents)
      (:predicates (g)) (:functions (fuel) (far ?x))
      (:durative-action go :parameters (?x) :duration (= ?duration (far ?x))
        :condition (at start (>= (fuel) (far ?x)))
        :effect (and (at end (g)) (at start (decrease (fuel) (* 2 ?duration))))))",
     "(:objects a b) (:init (= (far a) 3) (= (far b) 5) (= (fuel) 10)) (:goal (and (g) (>= (fuel) 4)))",
     "(:objects a b) (:init (= (far a) 3) (= (far b) 5) (= (fuel) 10)) (:goal (and (g) (>= (fuel) 5)))"},

    {"derived", R"((:requirements :typing :derived-predicates :negative-preconditions) (:types block)
      (:predicates (on ?a ?b - block) (free ?b - block) (above ?a ?b - block) (table ?b - block))
      (:derived (above ?a ?b - block) (or (on ?a ?b) (exists (?c - block) (and (on ?a ?c) (above ?c ?b)))))
      (:derived (free ?b - block) (not (exists (?a - block) (above ?a ?b))))
      (:action put :parameters (?a ?b - block)
        :precondition (and (table ?a) (free ?a) (free ?b) (not (above ?a ?b)) (not (= ?a ?b)))
        :effect (and (not (table ?a)) (on ?a ?b))))",
     "(:objects a b c - block) (:init (table a) (table b) (table c)) (:goal (and (above a c) (above b c) "
     "(above a b)))",
     "(:objects a b c - block) (:init (table a) (table b) (table c)) (:goal (and (above a b) (above b a)))"},
};

class Language : public ::testing::TestWithParam<Row> {};

TEST_P(Language, IsPlannedAndValidated) {
  const auto made = testing::model(GetParam().domain, GetParam().solvable);
  testing::expect_valid(made, testing::solved(made));
}

TEST_P(Language, HasNoPlanWhereThereIsNone) {
  const Result result = testing::solved(testing::model(GetParam().domain, GetParam().unsolvable));
  EXPECT_EQ(result.verdict, Verdict::unsolvable) << result.reason;
}

INSTANTIATE_TEST_SUITE_P(Rows, Language, ::testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace roci::planner::temporal_pddl
