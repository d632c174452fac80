// Functions of the state: what they say at the level at which an action starts.
#include "planner_svc/temporal_pddl/values/level_functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionsMode, engine::FunctionValue;
using temporal::Verdict;
using ::testing::ElementsAre, ::testing::SizeIs;

// A road of three places; each drive takes 60 of the battery.
testing::Model road(double battery) {
  return testing::model(R"((:requirements :typing :durative-actions :numeric-fluents) (:types place)
    (:modules (:module roads (:function (time ?a ?b - place) :depends-on ((battery) 0 20 50))))
    (:predicates (at ?p - place) (road ?a ?b - place)) (:functions (battery))
    (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))
      :condition (and (at start (at ?a)) (at start (road ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (decrease (battery) 60)))))",
                        "(:objects p0 p1 p2 - place) (:init (at p0) (road p0 p1) (road p1 p2) (= (battery) " +
                            std::to_string(battery) + ")) (:goal (at p2))");
}

// So many seconds as it says for the state, whatever the way; counts what it hears.
class BySlowness final : public engine::FunctionSource {
 public:
  std::map<double, double> seconds{{0, 100}, {20, 30}, {50, 10}};
  std::map<double, std::size_t> asked;

  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>&) override {
    std::vector<FunctionValue> answers;
    for (const FunctionCall& call : calls) {
      EXPECT_THAT(call.arguments, SizeIs(2)) << "as the owner declared it";
      EXPECT_THAT(call.state, SizeIs(1));
      EXPECT_EQ(call.state, calls.front().state);
      EXPECT_EQ(call.state[0].timeline, "(battery)");
      ++asked[call.state[0].number];
      FunctionValue answer;
      answer.outcome = FunctionOutcome::value;
      answer.value = seconds.at(call.state[0].number);
      answers.push_back(answer);
    }
    return answers;
  }
};

std::vector<double> durations(const testing::Model& model, const Result& result) {
  EXPECT_EQ(result.verdict, Verdict::solved) << result.reason;
  if (!result.plan) return {};
  const auto steps = pddl::parse_plan(to_ipc(*result.plan), "plan");
  EXPECT_EQ(checker::refusal(model.domain, model.problem, steps, result.functions), "");
  std::vector<double> out;
  for (const auto& activity : result.plan->activities)
    out.push_back(std::chrono::duration<double>(activity.end - activity.start).count());
  return out;
}

TEST(LevelFunctions, AnActionTakesWhatItTakesAtTheLevelAtWhichItStarts) {
  for (const FunctionsMode mode : {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
    call::Options options;
    options.functions = mode;
    BySlowness owner;
    EXPECT_THAT(durations(road(100), testing::solved(road(100), owner, options)), ElementsAre(10, 30));
    EXPECT_THAT(durations(road(70), testing::solved(road(70), owner, options)), ElementsAre(10, 100));
    EXPECT_THAT(durations(road(200), testing::solved(road(200), owner, options)), ElementsAre(10, 10));
  }
}

TEST(LevelFunctions, BelowTheLowestLevelNothingStarts) {
  BySlowness owner;
  EXPECT_EQ(testing::solved(road(50), owner).verdict, Verdict::unsolvable);
}

TEST(LevelFunctions, EachLevelIsAskedForInItsOwnBatch) {
  BySlowness owner;
  const Result result = testing::solved(road(100), owner);
  EXPECT_EQ(owner.asked, (std::map<double, std::size_t>{{0, 9}, {20, 9}, {50, 9}}));
  EXPECT_EQ(result.statistics.function_requests, 3U);
}

TEST(LevelFunctions, ThePlanNamesTheLevel) {
  BySlowness owner;
  const Result result = testing::solved(road(100), owner);
  ASSERT_TRUE(result.plan);
  EXPECT_THAT(result.plan->activities[1].arguments, ElementsAre("p1", "p2", "battery-20"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
