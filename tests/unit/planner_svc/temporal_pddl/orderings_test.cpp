#include "planner_svc/temporal_pddl/constraints/orderings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using constraints::Orderings, constraints::StepConstraint;
using task::Action, task::ActionId, task::FactId, task::Snap, task::SnapId, task::SnapKind, task::Task,
    task::VariableId;
using temporal::Duration, temporal::no_bound;
using testing::action;
using ::testing::UnorderedElementsAre;

constexpr Duration kEpsilon{1000};

StepConstraint after(std::uint32_t from, std::uint32_t to, Duration lower) {
  return {from, to, lower, no_bound};
}

std::vector<StepConstraint> orderings(const Task& task, const std::vector<SnapId>& steps) {
  Orderings rules(task, kEpsilon);
  std::vector<StepConstraint> result;
  std::vector<ActionId> running;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    rules.add(std::span(steps).first(i), steps[i], running, result);
    const Snap& snap = task.snaps[steps[i]];
    if (snap.kind == SnapKind::start) running.push_back(snap.action);
    if (snap.kind == SnapKind::end) std::erase(running, snap.action);
  }
  return result;
}

TEST(Orderings, FiveSteps) {
  const auto model = testing::model(R"(
    (:predicates (p) (q) (r) (g))
    (:action add-p :parameters () :precondition () :effect (p))
    (:action use-p :parameters () :precondition (p) :effect (q))
    (:action also-use-p :parameters () :precondition (p) :effect (r))
    (:action drop-p :parameters () :precondition (r) :effect (and (not (p)) (not (r))))
    (:action last :parameters () :precondition (q) :effect (and (p) (not (q)) (g))))",
                                    "(:init) (:goal (and (p) (g)))");
  const Task task = testing::grounded(model).task;
  std::vector<SnapId> steps;
  for (const char* name : {"(add-p)", "(use-p)", "(also-use-p)", "(drop-p)", "(last)"}) {
    steps.push_back(task.actions[action(task, name)].start);
  }
  EXPECT_THAT(
      orderings(task, steps),
      UnorderedElementsAre(after(0, 1, kEpsilon), after(0, 2, kEpsilon),  // conditions after the last effect
                           after(0, 3, kEpsilon),                         // effects in total order
                           after(1, 3, kEpsilon),                         // effects after conditions
                           after(2, 3, kEpsilon),                         // both
                           after(1, 4, kEpsilon), after(3, 4, kEpsilon)));
}

TEST(Orderings, InvariantsMayTouchWhatMakesAndBreaksThem) {
  const auto model = testing::model(R"(
    (:requirements :durative-actions)
    (:predicates (light) (g))
    (:durative-action match :parameters () :duration (= ?duration 5)
      :condition () :effect (and (at start (light)) (at end (not (light)))))
    (:durative-action mend :parameters () :duration (= ?duration 5)
      :condition (over all (light)) :effect (at end (g))))",
                                    "(:init) (:goal (g))");
  const Task task = testing::grounded(model).task;
  const Action& match = task.actions[action(task, "(match)")];
  const Action& mend = task.actions[action(task, "(mend)")];
  EXPECT_THAT(
      orderings(task, {match.start, mend.start, mend.end, match.end}),
      UnorderedElementsAre(after(0, 1, Duration{0}), after(2, 3, Duration{0}), after(0, 3, kEpsilon)));
}

TEST(Orderings, NumbersOfARunningInvariantAreReadWithEachChange) {
  const auto model = testing::model(R"(
    (:requirements :durative-actions :numeric-fluents)
    (:predicates (g))
    (:functions (x) (y))
    (:durative-action watch :parameters () :duration (= ?duration 5)
      :condition (over all (>= (+ (x) (y)) 1)) :effect (at end (g)))
    (:action more-x :parameters () :precondition () :effect (increase (x) 1))
    (:action less-y :parameters () :precondition () :effect (decrease (y) 1)))",
                                    "(:init (= (x) 0) (= (y) 1)) (:goal (g))");
  const Task task = testing::grounded(model).task;
  const SnapId watch = task.actions[action(task, "(watch)")].start;
  const SnapId more = task.actions[action(task, "(more-x)")].start;
  const SnapId less = task.actions[action(task, "(less-y)")].start;
  EXPECT_THAT(orderings(task, {watch, more, less}), UnorderedElementsAre(after(1, 2, kEpsilon)));
  EXPECT_TRUE(orderings(task, {more, less}).empty());
}

// R27: the same as with annotations that are kept while the plan grows.
class Annotated {
 public:
  explicit Annotated(const Task& task) : task_(task) {}

  void add(SnapId next, std::vector<StepConstraint>& constraints) {
    std::map<std::uint32_t, Duration> lower;
    const auto follow = [&](std::uint32_t step, Duration by) {
      const auto [place, added] = lower.emplace(step, by);
      if (!added) place->second = std::max(place->second, by);
    };
    const Snap& snap = task_.snaps[next];
    for (const VariableId v : task_.reads[next]) {
      if (modifier_.contains(v)) follow(modifier_[v], kEpsilon);
    }
    if (snap.kind == SnapKind::start) {
      for (const VariableId v : task_.invariant_reads[snap.action]) {
        if (modifier_.contains(v)) follow(modifier_[v], Duration{0});
      }
    }
    for (const VariableId v : task_.writes[next]) {
      if (modifier_.contains(v)) follow(modifier_[v], kEpsilon);
      for (const std::uint32_t reader : readers_[v]) follow(reader, kEpsilon);
      if (only_adds(next, v)) continue;
      for (const std::uint32_t end : invariant_ends_[v]) follow(end, Duration{0});
    }
    for (const auto& [step, by] : lower) constraints.push_back(after(step, count_, by));
    for (const VariableId v : task_.writes[next]) {
      modifier_[v] = count_;
      readers_[v].clear();
      if (!only_adds(next, v)) invariant_ends_[v].clear();
    }
    for (const VariableId v : task_.reads[next]) {
      if (!modifier_.contains(v) || modifier_[v] != count_) readers_[v].push_back(count_);
    }
    if (snap.kind == SnapKind::end) {
      for (const VariableId v : task_.invariant_reads[snap.action]) {
        if (!modifier_.contains(v) || modifier_[v] != count_ || only_adds(next, v))
          invariant_ends_[v].push_back(count_);
      }
    }
    ++count_;
  }

 private:
  bool only_adds(SnapId snap, VariableId v) const {
    for (const FactId added : task_.adds[snap]) {
      if (task_.variable(added) == v) return true;
    }
    return false;
  }

  const Task& task_;
  std::uint32_t count_ = 0;
  std::map<VariableId, std::uint32_t> modifier_;
  std::map<VariableId, std::vector<std::uint32_t>> readers_, invariant_ends_;
};

TEST(Orderings, WalkingBackwardsFindsWhatAnnotationsSay) {
  std::mt19937_64 random(6);
  std::size_t compared = 0;
  for (int round = 0; round < 200; ++round) {
    const auto model = testing::random_task(random);
    Task task;
    try {
      task = testing::grounded(model).task;
    } catch (const std::exception&) {
      continue;  // the goal is out of reach
    }
    std::vector<SnapId> steps;
    std::vector<ActionId> running;
    std::vector<StepConstraint> expected;
    Annotated annotated(task);
    for (int i = 0; i < 20 && !task.actions.empty(); ++i) {
      SnapId next = task.actions[ActionId(random() % task.actions.size())].start;
      if (!running.empty() && random() % 2 == 0) {
        next = task.actions[running[random() % running.size()]].end;
      } else if (std::ranges::count(running, task.snaps[next].action) > 0) {
        continue;
      }
      if (task.snaps[next].kind == SnapKind::start) running.push_back(task.snaps[next].action);
      if (task.snaps[next].kind == SnapKind::end) std::erase(running, task.snaps[next].action);
      steps.push_back(next);
      annotated.add(next, expected);
    }
    EXPECT_THAT(orderings(task, steps), ::testing::UnorderedElementsAreArray(expected));
    compared += expected.size();
  }
  EXPECT_GT(compared, 900u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
