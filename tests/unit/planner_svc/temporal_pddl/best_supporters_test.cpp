// BestSupporters against h_add by repeated relaxation until nothing changes, over random tasks.
#include "planner_svc/temporal_pddl/heuristics/best_supporters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::PlanningFailure;
using heuristics::BestSupporters, heuristics::NumericRelaxation, heuristics::OperatorCosts,
    heuristics::PropositionId, heuristics::RelaxedTask;
using task::FactId, task::SnapId, task::StateView, task::Task;

constexpr std::int64_t kFar = 1'000'000;

// Of a plain action of a task with one alternative of goals.
std::int64_t operator_cost(const Task& task, SnapId op, StateView state) {
  std::int64_t result = 1;
  for (const FactId fact : task.goals.front().facts) {
    const bool undone =
        std::ranges::count(task.deletes[op], fact) > 0 && std::ranges::count(task.adds[op], fact) == 0;
    if (undone && task.layout.holds(state, fact)) result += OperatorCosts::kGoalThreatPenalty;
  }
  return result;
}

// Of a task without comparisons.
struct Expected {
  std::vector<std::int64_t> propositions, operators;
};

Expected relax(const Task& task, const RelaxedTask& relaxed, StateView state) {
  Expected result{std::vector<std::int64_t>(relaxed.propositions(), kFar),
                  std::vector<std::int64_t>(relaxed.operators(), kFar)};
  RelaxedTask::each_fact(task, state, [&](FactId fact) { result.propositions[fact.index()] = 0; });
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < relaxed.operators(); ++i) {
      std::int64_t cost = operator_cost(task, SnapId(i), state);
      for (const PropositionId need : relaxed.needs(SnapId(i))) cost += result.propositions[need.index()];
      if (cost >= kFar) continue;
      result.operators[i] = cost;
      for (const PropositionId added : relaxed.adds(SnapId(i))) {
        if (cost >= result.propositions[added.index()]) continue;
        result.propositions[added.index()] = cost;
        changed = true;
      }
    }
  }
  return result;
}

// Actions with several needs each, so that what is reached first is not always reached most cheaply.
testing::Model random_model(std::mt19937_64& random) {
  constexpr std::size_t kFacts = 30;
  const auto any = [&] { return "(p" + std::to_string(random() % kFacts) + ")"; };
  std::string domain = "(:requirements :strips) (:predicates";
  for (std::size_t i = 0; i < kFacts; ++i) domain += " (p" + std::to_string(i) + ")";
  domain += ")";
  for (int i = 0; i < 60; ++i) {
    domain += "(:action a" + std::to_string(i) + " :parameters () :precondition (and";
    for (std::uint64_t needs = 1 + random() % 3; needs > 0; --needs) domain += " " + any();
    domain += ") :effect (and " + any() + " " + any() + " (not " + any() + ")))";
  }
  std::string goals;
  for (int i = 0; i < 6; ++i) goals += " " + any();
  return testing::model(domain, "(:init (p0) (p1) (p2)) (:goal (and" + goals + "))");
}

TEST(BestSupporters, CostsAreThoseOfFullRelaxationHoweverLittleIsAsked) {
  std::mt19937_64 random(7);
  std::size_t compared = 0;
  for (int round = 0; round < 200; ++round) {
    Task task;
    try {
      task = testing::grounded(random_model(random)).task;
    } catch (const PlanningFailure&) {
      continue;  // a goal is out of reach
    }
    const RelaxedTask relaxed(task);
    const NumericRelaxation numbers(task);
    if (numbers.comparisons() > 0 || relaxed.propositions() == 0) continue;
    BestSupporters supporters(task, relaxed, numbers);
    const Expected expected = relax(task, relaxed, task.initial_state);
    for (int asked = 0; asked < 5; ++asked) {
      supporters.begin({task.initial_state, {}, 0, nullptr, {}, {}}, nullptr);
      const PropositionId one(random() % relaxed.propositions());
      ASSERT_EQ(supporters.reaches(one), expected.propositions[one.index()] < kFar);
      if (!supporters.reaches(one)) continue;
      EXPECT_EQ(supporters.cost(one), expected.propositions[one.index()]);
      const SnapId supporter = supporters.supporter(one);
      if (!supporter.is_none()) {
        EXPECT_EQ(expected.operators[supporter.index()], supporters.cost(one));
      }
      const SnapId op(random() % relaxed.operators());
      EXPECT_EQ(supporters.reaches(op), expected.operators[op.index()] < kFar);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
