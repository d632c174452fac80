#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "core/pddl/printer.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionSource, engine::FunctionUse,
    engine::FunctionValue;

namespace {

using temporal::Verdict;
using testing::MapFunctions;

// Stellar, figure 2, verbatim, in a domain that uses it.
testing::Model arm() {
  return testing::model(R"(
    (:requirements :typing :durative-actions :numeric-fluents)
    (:types slot)
    (:modules (:module ef_orbitalrarmplanner
      (:function (ra_move_dur ?from ?to - slot))
      (:function (ra_move_energy ?to - slot))
    ))
    (:predicates (arm-at ?s - slot))
    (:functions (energy))
    (:durative-action move :parameters (?from ?to - slot) :duration (= ?duration (ra_move_dur ?from ?to))
      :condition (and (at start (arm-at ?from)) (at start (>= (energy) (ra_move_energy ?to))))
      :effect (and (at start (not (arm-at ?from))) (at start (decrease (energy) (ra_move_energy ?to)))
                   (at end (arm-at ?to)))))",
                        "(:objects a b c - slot) (:init (arm-at a) (= (energy) 10)) (:goal (arm-at c))");
}

MapFunctions all_values() {
  MapFunctions functions;
  for (const std::string from : {"a", "b", "c"}) {
    functions.set("(ra_move_energy " + from + ")", 2);
    for (const std::string to : {"a", "b", "c"}) functions.set("(ra_move_dur " + from + " " + to + ")", 12.5);
  }
  return functions;
}

// R37: all typed tuples once, one batch per function, none during the search.
TEST(Functions, AreEvaluatedOnceAndAtLoad) {
  MapFunctions functions = all_values();
  const Result result = testing::solved(arm(), functions);
  ASSERT_EQ(result.verdict, Verdict::solved) << result.reason;
  EXPECT_EQ(functions.batches, 2u);
  EXPECT_EQ(functions.calls, 3u * 3u + 3u);
  EXPECT_EQ(result.functions.size(), 12u);
  ASSERT_EQ(result.plan->activities.size(), 1u);
  EXPECT_EQ(result.plan->activities[0].end, std::chrono::milliseconds(12500));
  EXPECT_EQ(pddl::print(result.plan->activities[0].at_start[1]), "(>= (energy) 2)");
  const auto& change = std::get<pddl::Assignment>(result.plan->activities[0].start_effects[1].node);
  EXPECT_EQ(change.op, pddl::AssignmentOperator::decrease);
  EXPECT_EQ(pddl::print(change.fluent), "(energy)");
  EXPECT_EQ(pddl::print(change.value), "2");
}

TEST(Functions, UnreachableMeansThatTheInstanceDoesNotExist) {
  MapFunctions functions = all_values();
  functions.set("(ra_move_dur a c)", FunctionOutcome::unreachable);
  const Result result = testing::solved(arm(), functions);
  ASSERT_EQ(result.verdict, Verdict::solved) << result.reason;
  EXPECT_EQ(result.plan->activities.size(), 2u);
  functions.set("(ra_move_energy c)", FunctionOutcome::unreachable);
  EXPECT_EQ(testing::solved(arm(), functions).verdict, Verdict::unsolvable);
}

TEST(Functions, EachOtherOutcomeIsNamed) {
  for (const auto outcome :
       {FunctionOutcome::unavailable, FunctionOutcome::late, FunctionOutcome::not_a_number,
        FunctionOutcome::wrong_arity, FunctionOutcome::unknown_object}) {
    MapFunctions functions = all_values();
    functions.set("(ra_move_dur b c)", outcome);
    functions.answers["(ra_move_dur b c)"].provenance = engine::Provenance{"arm_svc", "", {}};
    functions.answers["(ra_move_dur b c)"].reason = "motor cold";
    const Result result = testing::solved(arm(), functions);
    EXPECT_EQ(result.verdict, Verdict::function_unavailable);
    for (const char* part :
         {"(ra_move_dur b c)", "ef_orbitalrarmplanner", to_string(outcome), "arm_svc", "motor cold"}) {
      EXPECT_THAT(result.reason, ::testing::HasSubstr(part));
    }
    EXPECT_FALSE(result.functions.empty());
  }
}

TEST(Functions, ANanIsNoValue) {
  MapFunctions functions = all_values();
  functions.set("(ra_move_energy b)", std::nan(""));
  const Result result = testing::solved(arm(), functions);
  EXPECT_EQ(result.verdict, Verdict::function_unavailable);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("not-a-number"));
}

TEST(Functions, ProvenanceComesBack) {
  MapFunctions functions = all_values();
  functions.answers["(ra_move_dur a c)"].provenance =
      engine::Provenance{"arm_svc", "7", std::chrono::microseconds(5)};
  const Result result = testing::solved(arm(), functions);
  const auto used = std::ranges::find(
      result.functions, FunctionCall{"ef_orbitalrarmplanner", "ra_move_dur", {"a", "c"}}, &FunctionUse::call);
  ASSERT_NE(used, result.functions.end());
  EXPECT_EQ(used->answer.provenance->owner, "arm_svc");
  EXPECT_EQ(used->answer.provenance->model_version, "7");
}

TEST(Functions, AShortAnswerCountsAsUnavailable) {
  class Short final : public FunctionSource {
    std::vector<FunctionValue> evaluate(std::span<const FunctionCall>,
                                        const std::function<bool()>&) override {
      return std::vector<FunctionValue>(1);
    }
  } functions;
  EXPECT_EQ(testing::solved(arm(), functions).verdict, Verdict::function_unavailable);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
