// What the engine counts as its memory against what it takes: operator new is replaced in this program.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "planner_svc/temporal_pddl/values/tuple_set.hpp"
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

// Has an action for each three of 30 objects.
testing::Model triples() {
  std::string objects, init;
  for (int i = 0; i < 30; ++i) {
    objects += " o" + std::to_string(i);
    init += " (p o" + std::to_string(i) + ")";
  }
  return testing::model(R"((:requirements :typing :durative-actions) (:types t)
    (:predicates (p ?a - t) (q ?a ?b ?c - t))
    (:durative-action a :parameters (?a ?b ?c - t) :duration (= ?duration 1)
      :condition (and (at start (p ?a)) (at start (p ?b)) (at start (p ?c)))
      :effect (and (at start (not (p ?a))) (at end (p ?a)) (at end (q ?a ?b ?c)))))",
                        "(:objects" + objects + " - t) (:init" + init + ") (:goal (q o0 o1 o2))");
}

TEST(Memory, OfGroundingIsCounted) { expect_honest(triples(), 100, 0.8); }

// What a ground action takes at the peak of a call, in bytes: it limits the problems that fit on board, and
// whoever makes an action larger changes this number knowingly.
constexpr double kMostBytesPerAction = 840;

TEST(Memory, OfAGroundActionDoesNotGrow) {
  const testing::Model model = triples();
  NoFunctions functions;
  Budget budget;
  budget.evaluations = 1;
  const std::size_t before = taken;
  most = taken;
  const Result result = plan(model.domain, model.problem, functions, budget, {});
  ASSERT_GT(result.statistics.actions, 20'000U);
  const double each = static_cast<double>(most - before) / static_cast<double>(result.statistics.actions);
  EXPECT_LT(each, kMostBytesPerAction);
  EXPECT_GT(each, 0.7 * kMostBytesPerAction) << "it takes less now: lower the bound";
}

// A drive from each place to each other one, with an energy of its own that the battery has to hold. Bytes of each.
double bytes_of_a_drive(int places) {
  std::string objects, energies;
  for (int from = 0; from < places; ++from) {
    objects += " p" + std::to_string(from);
    for (int to = 0; to < places; ++to)
      energies += " (= (energy p" + std::to_string(from) + " p" + std::to_string(to) + ") " +
                  std::to_string(1 + from * places + to) + ")";
  }
  const testing::Model model = testing::model(
      R"((:requirements :typing :numeric-fluents) (:types place) (:predicates (at ?p - place))
    (:functions (battery) (energy ?a ?b - place))
    (:action drive :parameters (?a ?b - place) :precondition (and (at ?a) (>= (battery) (energy ?a ?b)))
      :effect (and (not (at ?a)) (at ?b) (decrease (battery) (energy ?a ?b)))))",
      "(:objects" + objects + " - place) (:init (at p0) (= (battery) 100000)" + energies + ") (:goal (at p" +
          std::to_string(places - 1) + "))");
  NoFunctions functions;
  Budget budget;
  const std::size_t before = taken;
  most = taken;
  const Result result = plan(model.domain, model.problem, functions, budget, {});
  EXPECT_TRUE(result.plan.has_value());
  return static_cast<double>(most - before) / (places * (places - 1));
}

TEST(Memory, OfAnActionWithABoundOfItsOwnDoesNotGrow) {
  EXPECT_LT(bytes_of_a_drive(80), 1.2 * bytes_of_a_drive(40));
}

// A large satellite has tens of thousands of them, and a call of one takes some 200 bytes.
TEST(Memory, OfATupleOfAFunctionIsAFewBytes) {
  std::vector<engine::FunctionCall> calls;
  for (int from = 0; from < 100; ++from)
    for (int to = 0; to < 100; ++to)
      calls.push_back({"arm", "move_time", {"s" + std::to_string(from), "s" + std::to_string(to)}});
  const std::size_t before = taken;
  const values::TupleSet tuples(calls);
  EXPECT_LT(taken - before, 16 * tuples.size());
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
