// What becomes of a planning call when a value of an external function does not come, on every transport:
// each outcome under its own name, with who was asked, when, and for which model; never a hang (R35, R36).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "services/process/domain_claim.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/planner_svc/service/road_planning.hpp"

namespace roci::planner {
namespace {

using namespace std::chrono_literals;
using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FunctionOutcomes : public ::testing::TestWithParam<std::pair<const char*, RoadVendors>> {
 protected:
  // Asked at 1 s for a way from a to c.
  void fly(bool offered = true, const std::function<void(RoadPlanning&)>& prepare = {},
           const v1::PlanRequest& request = plan_request(kRoadDomain, road_problem())) {
    const services::process::DomainClaim domain;
    RoadPlanning planning(GetParam().second, domain.id(), offered);
    if (prepare) prepare(planning);
    planning.ask(1s, request);
    planning.run_until(100s);
    ASSERT_EQ(planning.replies().size(), 1U) << "one answer, whatever happened";
    ASSERT_EQ(planning.replies()[0].result.status, services::rpc::CallStatus::ok);
    time = planning.replies()[0].time;
    reply = planning.replies()[0].result.reply;
  }

  static v1::PlanGoal goal_of(const std::string& id, const std::string& fact) {
    v1::PlanGoal goal;
    goal.issuer("ground");
    goal.id(id);
    goal.achieved(services::wire::to_wire(temporal::compare(fact, temporal::ConditionOp::eq, true)));
    return goal;
  }

  // The owner answers, 250 ms later, with this for the tuple (a, c).
  static void owner_says(RoadPlanning& planning, v1::FunctionOutcome outcome, double number) {
    planning.owner_answers([&planning, outcome, number](const v1::FunctionRequest& request, auto responder) {
      const auto& tuples = request.batches()[0].tuples();
      v1::FunctionReply answer = ten_seconds(request, planning.owner().now());
      for (std::size_t i = 0; i < tuples.size(); i += 2) {
        if (request.objects()[tuples[i]].name() != "a" || request.objects()[tuples[i + 1]].name() != "c")
          continue;
        answer.results()[0].outcomes()[i / 2] = outcome;
        answer.results()[0].numbers()[i / 2] = number;
      }
      planning.owner().after(250ms, [responder, answer] { responder.reply(answer); });
    });
  }

  void expect_refusal(const std::string& what, temporal::Time when, const std::string& tuple = "a c") {
    EXPECT_EQ(reply.verdict_code(), v1::VERDICT_FUNCTION_UNAVAILABLE);
    EXPECT_THAT(reply.reason(),
                AllOf(HasSubstr("domain:5:"), HasSubstr("(travel_time " + tuple + ") of module roads: "),
                      HasSubstr(what)));
    EXPECT_EQ(time, when);
    EXPECT_TRUE(reply.solution().activities().empty());
  }

  v1::PlanReply reply;
  temporal::Time time{0};
};

// Who, when, for which map.
constexpr auto kAsked = "; asked roads_svc, model 7, at 1.000000 s";

TEST_P(FunctionOutcomes, AValueShapesThePlanAndKeepsItsProvenance) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_VALUE, 15); });
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(time, 1750ms);
  ASSERT_EQ(steps_of(reply.solution()), "go a c");
  EXPECT_EQ(reply.solution().activities()[0].duration_lower_us(), 15'000'000);
  const auto& uses = reply.solution().function_values();
  const auto use = std::ranges::find_if(uses, [](const v1::FunctionValueUse& candidate) {
    return candidate.arguments() == std::vector<std::string>{"a", "c"};
  });
  ASSERT_NE(use, uses.end());
  EXPECT_EQ(use->function(), "travel_time");
  EXPECT_EQ(use->number(), 15);
  EXPECT_EQ(use->owner(), "roads_svc");
  EXPECT_EQ(use->model_version(), 7U);
  EXPECT_EQ(use->computed_us(), 1'000'000);
}

TEST_P(FunctionOutcomes, AnUnreachableTupleIsGoneAround) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_UNREACHABLE, 0); });
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "go a b, go b c");
}

TEST_P(FunctionOutcomes, ATupleOfWhichNoValueWasFoundIsGoneAround) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_UNKNOWN, 0); });
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "go a b, go b c");
}

// The owner that searches harder by each request is asked again before the call ends without a plan.
TEST_P(FunctionOutcomes, WhatIsFoundWhenAskedAgainIsPlannedWith) {
  std::vector<std::size_t> asked;
  fly(true, [&](RoadPlanning& planning) {
    planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
      v1::FunctionReply answer = ten_seconds(request, planning.owner().now());
      asked.push_back(request.batches()[0].tuples().size() / 2);
      if (asked.size() < 3)
        for (auto& outcome : answer.results()[0].outcomes()) outcome = v1::FUNCTION_UNKNOWN;
      responder.reply(answer);
    });
  });
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "go a c");
  EXPECT_THAT(asked, ElementsAre(9, 9, 9));
}

TEST_P(FunctionOutcomes, WhereNoValueIsEverFoundNothingIsProvedAndTheGoalIsNamed) {
  v1::PlanRequest request = plan_request(kRoadDomain, road_problem("(and (at c) (at a))"));
  request.goals() = {goal_of("stay", "(at a)"), goal_of("trip", "(at c)")};
  std::vector<std::size_t> asked;
  fly(
      true,
      [&](RoadPlanning& planning) {
        planning.owner_answers([&](const v1::FunctionRequest& call, auto responder) {
          v1::FunctionReply answer = ten_seconds(call, planning.owner().now());
          const auto& tuples = call.batches()[0].tuples();
          asked.push_back(tuples.size() / 2);
          for (std::size_t i = 0; i < tuples.size(); i += 2)
            if (call.objects()[tuples[i + 1]].name() == "c")
              answer.results()[0].outcomes()[i / 2] = v1::FUNCTION_UNKNOWN;
          responder.reply(answer);
        });
      },
      request);
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_TIMEOUT);
  EXPECT_THAT(reply.reason(), HasSubstr("not known: roads_svc found no way for (travel_time a c) and 2 more "
                                        "with the effort spent; ask again or give it more"));
  ASSERT_EQ(reply.blocking().size(), 1U) << "the other goal stands on no value";
  EXPECT_EQ(reply.blocking()[0].id(), "trip");
  EXPECT_EQ(reply.blocking()[0].reason(),
            "no way to c is known: roads_svc found none with the effort spent (travel_time, model 7), which "
            "proves nothing; ask again, or let it search longer; asked 5 times");
  EXPECT_THAT(asked, ElementsAre(9, 3, 3, 3, 3)) << "what was found is not asked for again";
}

TEST_P(FunctionOutcomes, NobodyOwnsTheFunction) {
  fly(false);
  expect_refusal("unavailable, no service offers module 'roads'; offered are: none", 1500ms, "a a");
}

TEST_P(FunctionOutcomes, TheOwnerIsGone) {
  fly(true, [](RoadPlanning& planning) { planning.owner().at(500ms, [] { throw services::Crash{}; }); });
  expect_refusal(std::string("unavailable, roads_svc is not there to answer roci/function/request") + kAsked,
                 1500ms, "a a");
}

TEST_P(FunctionOutcomes, TheAnswerIsLate) {
  fly(true, [](RoadPlanning& planning) {
    planning.owner_answers([&planning](const v1::FunctionRequest& request, auto responder) {
      const v1::FunctionReply answer = ten_seconds(request, planning.owner().now());
      planning.owner().after(30s, [responder, answer] { responder.reply(answer); });
    });
  });
  expect_refusal(std::string("late, no answer to roci/function/request before the deadline") + kAsked,
                 21500ms, "a a");
}

TEST_P(FunctionOutcomes, NotANumber) {
  fly(true, [](RoadPlanning& planning) {
    owner_says(planning, v1::FUNCTION_VALUE, std::numeric_limits<double>::quiet_NaN());
  });
  expect_refusal(std::string("not-a-number") + kAsked, 1750ms);
}

TEST_P(FunctionOutcomes, Infinite) {
  fly(true, [](RoadPlanning& planning) {
    owner_says(planning, v1::FUNCTION_VALUE, std::numeric_limits<double>::infinity());
  });
  expect_refusal(std::string("not-a-number") + kAsked, 1750ms);
}

TEST_P(FunctionOutcomes, AnUnknownObject) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_UNKNOWN_OBJECT, 0); });
  expect_refusal(std::string("unknown-object") + kAsked, 1750ms);
}

TEST_P(FunctionOutcomes, AnotherArity) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_WRONG_ARITY, 0); });
  expect_refusal(std::string("wrong-arity") + kAsked, 1750ms);
}

TEST_P(FunctionOutcomes, AFunctionThatTheOwnerDoesNotKnow) {
  fly(true, [](RoadPlanning& planning) { owner_says(planning, v1::FUNCTION_UNKNOWN_FUNCTION, 0); });
  expect_refusal(std::string("unavailable, it does not know this function") + kAsked, 1750ms);
}

TEST_P(FunctionOutcomes, TooFewValues) {
  fly(true, [](RoadPlanning& planning) {
    planning.owner_answers([&planning](const v1::FunctionRequest& request, auto responder) {
      v1::FunctionReply answer = ten_seconds(request, planning.owner().now());
      answer.results()[0].numbers().pop_back();
      responder.reply(answer);
    });
  });
  expect_refusal(
      std::string("unavailable, it answered with another number of values than asked for") + kAsked, 1500ms,
      "a a");
}

TEST_P(FunctionOutcomes, TheOwnerRefuses) {
  fly(true, [](RoadPlanning& planning) {
    planning.owner_answers([](const v1::FunctionRequest&, auto responder) {
      responder.fail(v1::REMOTE_EX_INVALID_ARGUMENT, "the map is being loaded");
    });
  });
  expect_refusal(std::string("unavailable, the map is being loaded") + kAsked, 1500ms, "a a");
}

TEST_P(FunctionOutcomes, TheOwnerDiesDuringTheCall) {
  fly(true, [](RoadPlanning& planning) {
    planning.owner_answers([&planning](const v1::FunctionRequest&, auto) {
      planning.owner().after(5s, [] { throw services::Crash{}; });
    });
  });
  expect_refusal(
      std::string("owner-lost, roads_svc (killed) while it answered roci/function/request") + kAsked, 6500ms,
      "a a");
}

INSTANTIATE_TEST_SUITE_P(Transports, FunctionOutcomes, ::testing::ValuesIn(kRoadTransports),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace roci::planner
