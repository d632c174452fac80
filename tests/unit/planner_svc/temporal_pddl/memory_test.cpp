// What the engine counts as its memory against what it takes: operator new is replaced in this program.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace {

std::size_t taken = 0;
std::size_t most = 0;

void* take(std::size_t size) {
  void* const memory = std::malloc(size);
  if (!memory) throw std::bad_alloc();
  taken += malloc_usable_size(memory);
  most = std::max(most, taken);
  return memory;
}

void give_back(void* memory) {
  taken -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return take(size); }
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }

namespace roci::planner::temporal_pddl {

using engine::NoFunctions;

namespace {

using call::Budget;

// share: of what is taken, how much at least is counted.
void expect_honest(const testing::Model& model, std::size_t evaluations, double share) {
  NoFunctions functions;
  Budget budget;
  budget.evaluations = evaluations;
  const std::size_t before = taken;
  most = taken;
  const Result result = plan(model.domain, model.problem, functions, budget, {});
  const auto counted = static_cast<double>(result.statistics.peak_bytes);
  const auto real = static_cast<double>(most - before);
  EXPECT_GT(real, 5e6);
  EXPECT_GT(counted, share * real) << counted << " of " << real;
  EXPECT_LT(counted, 1.1 * real) << counted << " of " << real;
}

TEST(Memory, OfGroundingIsCounted) {
  std::string objects, init;
  for (int i = 0; i < 30; ++i) {
    objects += " o" + std::to_string(i);
    init += " (p o" + std::to_string(i) + ")";
  }
  expect_honest(testing::model(R"((:requirements :typing :durative-actions) (:types t)
    (:predicates (p ?a - t) (q ?a ?b ?c - t))
    (:durative-action a :parameters (?a ?b ?c - t) :duration (= ?duration 1)
      :condition (and (at start (p ?a)) (at start (p ?b)) (at start (p ?c)))
      :effect (and (at start (not (p ?a))) (at end (p ?a)) (at end (q ?a ?b ?c)))))",
                               "(:objects" + objects + " - t) (:init" + init + ") (:goal (q o0 o1 o2))"),
                100, 0.8);
}

// Trucks, drivers and packages among places, as in driverlog.
testing::Model deliveries(int places, int others) {
  std::string objects, init, goal;
  for (int i = 0; i < places; ++i) {
    objects += " p" + std::to_string(i) + " - place";
    for (int j = 0; j < places; ++j)
      if (i != j) init += "(link p" + std::to_string(i) + " p" + std::to_string(j) + ")";
  }
  for (int i = 0; i < others; ++i) {
    const std::string n = std::to_string(i);
    objects += " t" + n + " - truck d" + n + " - driver k" + n + " - package";
    for (const std::string thing : {"t", "d", "k"})
      init += "(at " + thing + n + " p" + std::to_string(i % places) + ")";
    init += "(empty t" + n + ")";
    goal += "(at k" + n + " p" + std::to_string((i + 1) % places) + ")";
  }
  return testing::model(R"((:requirements :typing :durative-actions)
    (:types place locatable - object driver truck package - locatable)
    (:predicates (at ?x - locatable ?p - place) (in ?k - package ?t - truck) (driving ?d - driver ?t - truck)
      (link ?a ?b - place) (empty ?t - truck))
    (:durative-action load :parameters (?k - package ?t - truck ?p - place) :duration (= ?duration 2)
      :condition (and (over all (at ?t ?p)) (at start (at ?k ?p)))
      :effect (and (at start (not (at ?k ?p))) (at end (in ?k ?t))))
    (:durative-action unload :parameters (?k - package ?t - truck ?p - place) :duration (= ?duration 2)
      :condition (and (over all (at ?t ?p)) (at start (in ?k ?t)))
      :effect (and (at start (not (in ?k ?t))) (at end (at ?k ?p))))
    (:durative-action board :parameters (?d - driver ?t - truck ?p - place) :duration (= ?duration 1)
      :condition (and (over all (at ?t ?p)) (at start (at ?d ?p)) (at start (empty ?t)))
      :effect (and (at start (not (at ?d ?p))) (at end (driving ?d ?t)) (at start (not (empty ?t)))))
    (:durative-action leave :parameters (?d - driver ?t - truck ?p - place) :duration (= ?duration 1)
      :condition (and (over all (at ?t ?p)) (at start (driving ?d ?t)))
      :effect (and (at start (not (driving ?d ?t))) (at end (at ?d ?p)) (at end (empty ?t))))
    (:durative-action drive :parameters (?t - truck ?a ?b - place ?d - driver) :duration (= ?duration 10)
      :condition (and (at start (at ?t ?a)) (over all (driving ?d ?t)) (at start (link ?a ?b)))
      :effect (and (at start (not (at ?t ?a))) (at end (at ?t ?b)))))",
                        "(:objects" + objects + ") (:init " + init + ") (:goal (and " + goal + "))");
}

// Bounds are for a 64-bit machine.
TEST(Memory, OfAGroundActionIsFewHundredBytes) {
  const testing::Model model = deliveries(24, 8);
  const std::size_t before = taken;
  most = taken;
  const grounding::Grounding made = testing::grounded(model);
  const auto actions = static_cast<double>(made.task.actions.size());
  ASSERT_GT(actions, 30'000);
  const double kept = static_cast<double>(made.task.bytes()) / actions;
  const double at_most = static_cast<double>(most - before) / actions;
  RecordProperty("bytes_kept", static_cast<int>(kept));
  RecordProperty("bytes_at_most", static_cast<int>(at_most));
  EXPECT_LT(kept, 260) << "bytes of the task per ground action";
  EXPECT_LT(at_most, 620) << "bytes per ground action while grounding, at most";
}

// Tables grow by doubling, which takes half as much again for a moment.
TEST(Memory, OfTheSearchIsCounted) {
  expect_honest(
      testing::model(
          R"((:requirements :typing :numeric-fluents) (:types t) (:predicates (p)) (:functions (x ?i - t))
    (:action up :parameters (?i - t) :precondition () :effect (increase (x ?i) 1)))",
          "(:objects a b c d e f - t) (:init (= (x a) 0) (= (x b) 0) (= (x c) 0) (= (x d) 0) (= (x e) 0)"
          " (= (x f) 0)) (:goal (= (+ (x a) (x b) (x c) (x d) (x e) (x f)) 99.5))"),
      20'000, 0.6);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
