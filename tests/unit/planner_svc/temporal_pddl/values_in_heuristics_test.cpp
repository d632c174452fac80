// Values of external functions count in the heuristics, whatever is behind the function (R39): as costs of relaxed
// plans, as times before which nothing can happen, as amounts that numbers lack, and by the level of the state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using engine::FunctionsMode;
using heuristics::Estimate, heuristics::FfHeuristic;
using testing::MapFunctions;

// Two places on the way from home to the goal, over a left or a right one; energy for each drive.
testing::Model ways(const std::string& more = "(= (energy) 100)") {
  return testing::model(
      R"((:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals)
    (:types place)
    (:modules (:module roads (:function (time ?a ?b - place)) (:function (cost ?b - place))))
    (:predicates (at ?p - place) (road ?a ?b - place) (open)) (:functions (energy))
    (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))
      :condition (and (at start (at ?a)) (at start (road ?a ?b)) (at end (open))
                      (at start (>= (energy) (cost ?b))))
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at start (decrease (energy) (cost ?b))))))",
      "(:objects home left right goal - place) (:init (at home) (road home left) (road home right) "
      "(road left goal) (road right goal) (open) " +
          more + ") (:goal (at goal))");
}

MapFunctions roads(double to_goal, double cost) {
  MapFunctions out;
  for (const std::string a : {"home", "left", "right", "goal"}) {
    out.set("(cost " + a + ")", cost);
    for (const std::string b : {"home", "left", "right", "goal"})
      out.set("(time " + a + " " + b + ")", b == "goal" ? to_goal : 10);
  }
  return out;
}

Estimate of_start(const testing::Model& model, engine::FunctionSource& functions) {
  const call::Budget budget;
  const call::Monitor monitor;
  call::SearchLimits limits(budget, monitor);
  grounding::GroundingReport report;
  const auto grounding = grounding::ground(model.domain, model.problem, functions, {}, limits, report);
  FfHeuristic heuristic(grounding.task);
  Estimate out;
  const std::vector<task::Word> state = grounding.task.initial_state;
  heuristic.evaluate({state, {}, 0, nullptr, {}, {}}, out);
  return out;
}

TEST(ValuesInHeuristics, DurationsAreTheCostOfTheRelaxedPlan) {
  for (const double to_goal : {7.0, 30.0, 400.0}) {
    MapFunctions functions = roads(to_goal, 1);
    EXPECT_EQ(of_start(ways(), functions).cost, static_cast<std::int64_t>((10 + to_goal) * 1e6));
  }
}

TEST(ValuesInHeuristics, AGoalThatTheyMakeTooLateIsADeadEndBeforeAnySearch) {
  const testing::Model closing = ways("(= (energy) 100) (at 25 (not (open)))");
  MapFunctions quick = roads(14, 1);
  EXPECT_FALSE(of_start(closing, quick).dead_end);
  MapFunctions slow = roads(16, 1);
  const Result result = testing::solved(closing, slow);
  EXPECT_EQ(result.verdict, temporal::Verdict::unsolvable);
  EXPECT_EQ(result.statistics.expanded, 0U);
}

TEST(ValuesInHeuristics, AnAmountThatIsNotThereIsADeadEndBeforeAnySearch) {
  MapFunctions cheap = roads(10, 100);
  EXPECT_FALSE(of_start(ways(), cheap).dead_end);
  MapFunctions dear = roads(10, 101);
  const Result result = testing::solved(ways(), dear);
  EXPECT_EQ(result.verdict, temporal::Verdict::unsolvable);
  EXPECT_EQ(result.statistics.expanded, 0U);
}

// By 18 the battery is on the level of 0; what counts is the value there.
TEST(ValuesInHeuristics, AFunctionOfTheStateCountsByItsLevel) {
  const auto model = [](double battery) {
    return testing::model(R"((:requirements :typing :durative-actions :numeric-fluents) (:types place)
      (:modules (:module roads (:function (time ?a ?b - place) :depends-on ((battery) 0 20))))
      (:predicates (at ?p - place) (road ?a ?b - place)) (:functions (battery))
      (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))
        :condition (and (at start (at ?a)) (at start (road ?a ?b)))
        :effect (and (at start (not (at ?a))) (at end (at ?b)))))",
                          "(:objects p q - place) (:init (at p) (road p q) (= (battery) " +
                              std::to_string(battery) + ")) (:goal (at q))");
  };
  MapFunctions functions;
  for (const std::string a : {"p", "q"})
    for (const std::string b : {"p", "q"}) {
      functions.set("(time " + a + " " + b + " battery-0)", 90);
      functions.set("(time " + a + " " + b + " battery-20)", 30);
    }
  EXPECT_EQ(of_start(model(18), functions).cost, 90'000'000);
  EXPECT_EQ(of_start(model(20), functions).cost, 30'000'000);
}

// Where only a bound is known the heuristic counts with it, and with the exact value in the next round: the way whose
// bound was too good is left, and what the search never came near is not asked for.
TEST(ValuesInHeuristics, AreRefinedFromRoundToRound) {
  class Bounded final : public engine::FunctionSource {
   public:
    std::vector<std::string> asked_exactly;
    std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                                const std::function<bool()>&) override {
      std::vector<engine::FunctionValue> out;
      for (const engine::FunctionCall& call : calls) {
        const bool exact = call.accuracy == temporal::FunctionAccuracy::exact;
        const bool left = call.function == "time" && call.arguments[1] == "left";
        if (exact) asked_exactly.push_back(engine::application(call));
        engine::FunctionValue value;
        value.outcome = engine::FunctionOutcome::value;
        value.accuracy = call.accuracy;
        value.value = call.function == "cost" ? 1 : left ? (exact ? 500 : 5) : 10;
        out.push_back(value);
      }
      return out;
    }
  } functions;
  call::Options options;
  options.functions = FunctionsMode::two_accuracy;
  options.improvement_evaluations = 100;
  const Result result = testing::solved(ways(), functions, options);
  ASSERT_TRUE(result.plan);
  EXPECT_EQ(result.plan->activities[0].arguments[1], "right");
  EXPECT_GE(result.statistics.rounds, 2U);
  EXPECT_THAT(functions.asked_exactly, ::testing::Contains("(time home left)"));
  EXPECT_THAT(functions.asked_exactly, ::testing::Not(::testing::Contains("(time goal home)")));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
