// Inputs that are deep and wide, on a small stack: nothing recurses as deep as an input has parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"
#include "tests/unit/small_stack.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using roci::small_stack::on_small_stack;
using temporal::Verdict;
using ::testing::HasSubstr;

constexpr int kMany = 1200;

Result solved_on_small_stack(const testing::Model& model, const call::Options& options = {}) {
  Result result;
  on_small_stack([&] { result = testing::solved(model, options); });
  return result;
}

// One text for each i: before, i, after.
std::string repeated(const std::string& before, const std::string& after, int count = kMany) {
  std::string text;
  for (int i = 0; i < count; ++i) text += before + std::to_string(i) + after;
  return text;
}

// The successor generator has a level for each variable.
TEST(DeepAndWide, ManyVariables) {
  const auto model = testing::model(
      "(:predicates (p ?x) (q ?x)) (:action turn :parameters (?x) :precondition (p ?x) :effect (and (not (p "
      "?x)) "
      "(q ?x)))",
      "(:objects" + repeated(" o", "") + ") (:init" + repeated("(p o", ")") + ") (:goal (q o7))");
  testing::expect_valid(model, solved_on_small_stack(model));
}

TEST(DeepAndWide, ManyConditionsOfAnAction) {
  const auto model =
      testing::model("(:constants" + repeated(" o", "") +
                         ") (:predicates (p ?x) (g)) (:action a :parameters () :precondition (and" +
                         repeated("(p o", ")") + ") :effect (and (g) (not (p o0))))",
                     "(:init" + repeated("(p o", ")") + ") (:goal (g))");
  testing::expect_valid(model, solved_on_small_stack(model));
}

// A relaxed plan may be one chain.
TEST(DeepAndWide, ALongChainOfActions) {
  std::string next;
  for (int i = 1; i < kMany; ++i) next += "(next o" + std::to_string(i - 1) + " o" + std::to_string(i) + ")";
  const std::string goal = "(at o" + std::to_string(kMany - 1) + ")";
  const auto grounding = testing::grounded(testing::model(
      "(:predicates (at ?x) (next ?x ?y)) (:action step :parameters (?x ?y) :precondition (and (at ?x) (next "
      "?x ?y)) "
      ":effect (and (not (at ?x)) (at ?y)))",
      "(:objects" + repeated(" o", "") + ") (:init (at o0)" + next + ") (:goal " + goal + ")"));
  heuristics::FfHeuristic ff(grounding.task);
  std::vector<task::SnapId> plan;
  on_small_stack([&] {
    ASSERT_TRUE(ff.look_at({grounding.task.initial_state, {}, 0, nullptr, {}, {}}));
    ASSERT_EQ(ff.distance(testing::fact(grounding.task, goal)), kMany - 1);
    ff.plan_for(testing::fact(grounding.task, goal), plan);
  });
  EXPECT_EQ(plan.size(), static_cast<std::size_t>(kMany - 1));
}

TEST(DeepAndWide, ManyDisjunctionsInADerivedPredicate) {
  const auto domain = [](const std::string& body) {
    return "(:requirements :derived-predicates :disjunctive-preconditions) (:constants" + repeated(" o", "") +
           ") (:predicates (p ?x) (q ?x) (d) (g)) (:derived (d) (and" + body +
           ")) (:action a :parameters () :precondition (d) :effect (g))";
  };
  const std::string problem = "(:init" + repeated("(p o", ")") + ") (:goal (g))";
  const auto one_each = testing::model(domain(repeated("(or (p o", "))")), problem);
  testing::expect_valid(one_each, solved_on_small_stack(one_each));

  std::string two_each;
  for (int i = 0; i < 40; ++i)
    two_each += "(or (p o" + std::to_string(i) + ") (q o" + std::to_string(i) + "))";
  const Result refused = solved_on_small_stack(testing::model(domain(two_each), problem));
  EXPECT_EQ(refused.verdict, Verdict::unsupported);
  EXPECT_THAT(refused.reason, HasSubstr("derived predicate d has too many combinations of alternatives"));
}

TEST(DeepAndWide, TooManyVariablesAreRefusedByTheirNumber) {
  const Result refused = solved_on_small_stack(
      testing::model("(:predicates (p ?x) (g)) (:action a :parameters (" + repeated("?v", " ", 300) +
                         ") :precondition (p ?v0) :effect (g))",
                     "(:objects o) (:init (p o)) (:goal (g))"));
  EXPECT_EQ(refused.verdict, Verdict::unsupported);
  EXPECT_THAT(refused.reason, HasSubstr("over 256 variables are not supported"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
