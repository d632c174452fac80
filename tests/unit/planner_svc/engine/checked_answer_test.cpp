// One call through the seam: what leaves it, whatever the engine does.
#include "planner_svc/engine/checked_answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace roci::planner::engine {
namespace {

using temporal::Verdict;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Does what the request's model says.
class ScriptedEngine final : public AnsweringEngine {
 public:
  Answer answer(const Request& request, const Limits& limits, FunctionSource& functions) override {
    if (request.model == "throws") throw std::runtime_error("the abacus is broken");
    if (request.model == "exhausts") throw std::bad_alloc();
    if (request.model == "blocked") {
      Answer out = without_plan(Verdict::unsolvable, "out of reach");
      out.blocking = {{"ground", "photo", "rover.camera", "nothing turns it on"}};
      return out;
    }
    if (limits.cancelled()) return without_plan(Verdict::cancelled, "cancelled");
    const std::vector<FunctionCall> calls{{"roads", "travel_time", {"a", "b"}}};
    if (request.model == "asks") functions.evaluate(calls, limits.cancelled);
    Answer out;
    out.verdict = Verdict::solved;
    out.plan.emplace();
    out.plan->id = request.model;
    out.record = {{".model", request.model}};
    return out;
  }
};

// Has something against plans of some names, and hears the values of the call.
class ScriptedChecker final : public Checker {
 public:
  std::vector<std::string> faults(const CheckedPlan& checked) const override {
    if (checked.plan.id == "bad") return {"it is bad", "it is worse"};
    if (checked.plan.id == "uncheckable") throw std::runtime_error("no light");
    if (checked.plan.id == "asks" && checked.values.size() != 1) return {"it hides values"};
    return {};
  }
};

class NoSteps final : public SteppedEngine {
 public:
  StepOutput step(const StepInputs&) override { return {}; }
};

Table table() {
  const auto checker = [] { return std::make_unique<ScriptedChecker>(); };
  return {{"scripted", {MakeAnswering([] { return std::make_unique<ScriptedEngine>(); }), checker}},
          {"restless", {MakeStepped([](const Setup&) { return std::make_unique<NoSteps>(); }), checker}}};
}

Answer answer_to(const std::string& model, const std::string& engine = "scripted") {
  Request request;
  request.engine = engine;
  request.model = model;
  NoFunctions functions;
  return answer_checked(table(), request, {}, functions);
}

TEST(CheckedAnswer, APlanThatTheCheckerAcceptsIsGivenOut) {
  const Answer answer = answer_to("good");
  EXPECT_EQ(answer.verdict, Verdict::solved);
  ASSERT_TRUE(answer.plan);
  EXPECT_EQ(answer.plan->id, "good");
}

TEST(CheckedAnswer, APlanThatTheCheckerRefusesIsADefectAndNotGivenOut) {
  const Answer answer = answer_to("bad");
  EXPECT_EQ(answer.verdict, Verdict::crashed);
  EXPECT_FALSE(answer.plan);
  EXPECT_EQ(answer.reason, "the plan of engine 'scripted' is refused by its checker: it is bad; it is worse");
  EXPECT_THAT(answer.record, SizeIs(1)) << "what was asked is kept";
}

TEST(CheckedAnswer, APlanThatCannotBeCheckedIsNotGivenOut) {
  const Answer answer = answer_to("uncheckable");
  EXPECT_EQ(answer.verdict, Verdict::crashed);
  EXPECT_THAT(answer.reason, HasSubstr("it cannot be checked, no light"));
}

TEST(CheckedAnswer, TheCheckerHearsTheValuesFromTheirOwners) {
  const Answer answer = answer_to("asks");
  EXPECT_EQ(answer.verdict, Verdict::solved) << answer.reason;
  EXPECT_EQ(answer.statistics.function_tuples, 1U);
}

TEST(CheckedAnswer, WhatAnEngineThrowsIsAVerdict) {
  EXPECT_EQ(answer_to("throws").verdict, Verdict::crashed);
  EXPECT_EQ(answer_to("throws").reason, "the abacus is broken");
  EXPECT_EQ(answer_to("exhausts").verdict, Verdict::out_of_memory);
}

TEST(CheckedAnswer, BlockingGoalsComeTyped) {
  EXPECT_THAT(answer_to("blocked").blocking,
              ElementsAre(BlockingGoal{"ground", "photo", "rover.camera", "nothing turns it on"}));
}

TEST(CheckedAnswer, AnUnknownEngineIsToldWithThoseThatAnswer) {
  const Answer unknown = answer_to("good", "crystal_ball");
  EXPECT_EQ(unknown.verdict, Verdict::unsupported);
  EXPECT_EQ(unknown.reason, "unknown engine 'crystal_ball'; this planner has: scripted");
  const Answer stepped = answer_to("good", "restless");
  EXPECT_EQ(stepped.verdict, Verdict::unsupported);
  EXPECT_THAT(stepped.reason, AllOf(HasSubstr("takes no calls"), HasSubstr("scripted")));
}

}  // namespace
}  // namespace roci::planner::engine
