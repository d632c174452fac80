// The engine that answers calls, as a process: a mission without PDDL, site or arm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/wire/plan_wire.hpp"
#include "tests/engines/model/lock.hpp"
#include "tests/engines/model/task_model.hpp"
#include "tests/engines/planner_process.hpp"

namespace roci::planner::proof {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;
using services::rpc::CallStatus;
using temporal::Time;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Values = std::vector<Held>;
const Values kAtRest = {
    {"level", "low"}, {"lower", "shut"}, {"upper", "shut"}, {"ship", "below"}, {"quay", "dry"}};

v1::PlanGoal goal_of(const std::string& id, const Values& held) {
  v1::PlanGoal goal;
  goal.issuer("ground");
  goal.id(id);
  goal.achieved(services::wire::to_wire(condition_of(held)));
  goal.preferred_us(-1);
  return goal;
}

v1::PlanRequest request_for(const std::vector<v1::PlanGoal>& goals, const Values& state = kAtRest,
                            const std::string& model = kLockModel) {
  v1::PlanRequest request;
  request.engine("search");
  request.model(model);
  request.origin_us(1'000'000);
  for (const Held& held : state) {
    v1::NamedValue value;
    value.name(held.timeline);
    value.held(services::wire::to_wire(temporal::state(held.value)));
    request.state().push_back(std::move(value));
  }
  v1::NamedValue energy;
  energy.name("energy");
  energy.held(services::wire::to_wire(temporal::Value(100.0)));
  request.state().push_back(std::move(energy));
  request.goals(goals);
  return request;
}

// The lock whose pumps know themselves how long they take.
std::string model_that_asks() {
  std::string model = kLockModel;
  const std::string known = "pumps fill 300";
  return model.replace(model.find(known), known.size(), "pumps fill pumps.fill_time");
}

std::string tasks_of(const v1::Plan& plan) {
  std::string out;
  for (const v1::PlanActivity& activity : plan.activities())
    out += (out.empty() ? "" : ", ") + activity.name();
  return out;
}

class Answering : public ::testing::TestWithParam<Pairing> {
 protected:
  struct Answered {
    Time time;
    services::CallResult<v1::PlanReply> result;
  };

  void ask_at(Time time, const v1::PlanRequest& request) {
    run.node().at(time, [this, request] {
      newest = planner.call(request, "planner_svc", 5000s, [this](const auto& result) {
        replies.push_back({run.node().now(), result});
      });
    });
  }

  const v1::PlanReply& reply(std::size_t index) {
    static const v1::PlanReply none;
    EXPECT_GT(replies.size(), index);
    return index < replies.size() ? replies[index].result.reply : none;
  }

  // `on_request` is called in the middle of a call that asks for values, and answers or does not.
  void own_pumps(std::function<void(const services::Responder<v1::FunctionReply>&)> on_request) {
    v1::FunctionOffer offer;
    offer.module_name("pumps");
    offer.owner("exec_svc");
    services::advertise(run.node(), topics::function_offer).write(offer);
    services::serve(run.node(), topics::function_call,
                    [on_request = std::move(on_request)](const v1::FunctionRequest&, auto responder) {
                      on_request(responder);
                    });
  }

  static v1::FunctionReply pump_time(double seconds) {
    v1::FunctionReply out;
    out.owner("exec_svc");
    out.results().resize(1);
    out.results()[0].function("fill_time");
    out.results()[0].numbers({seconds});
    out.results()[0].outcomes({v1::FUNCTION_VALUE});
    return out;
  }

  PlannerProcess run{"search", GetParam().own, GetParam().planner};
  services::Client<v1::PlanRequest, v1::PlanReply> planner{run.node(), topics::plan_request};
  services::rpc::CallId newest = 0;
  std::vector<Answered> replies;
};

TEST_P(Answering, PlansFromTheStateThatItIsGivenToTheGoalThatIsAsked) {
  ask_at(1s, request_for({goal_of("lift", {{"ship", "above"}})}));
  ask_at(10s, request_for({goal_of("lift", {{"ship", "above"}})},
                          {{"level", "high"}, {"lower", "shut"}, {"upper", "shut"}, {"ship", "inside"}}));
  ask_at(20s, request_for({goal_of("full", {{"level", "high"}})}));
  run.run_until(30s);
  EXPECT_EQ(tasks_of(reply(0).solution()),
            "open-lower, enter-below, shut-lower, fill, open-upper, leave-above");
  EXPECT_EQ(tasks_of(reply(1).solution()), "open-upper, leave-above") << "another state, another plan";
  EXPECT_EQ(tasks_of(reply(2).solution()), "fill") << "another goal, another plan";
  EXPECT_EQ(replies[0].time, 1500ms) << "by the stated model of how long a call takes";
  const v1::PlanActivity& fill = reply(2).solution().activities().at(0);
  EXPECT_EQ(fill.commands().at(0).owner(), "lock_svc");
  EXPECT_THAT(fill.goals_served(), ElementsAre("ground/full"));
  EXPECT_EQ(services::wire::from_wire(fill.pre()),
            condition_of({{"lower", "shut"}, {"upper", "shut"}, {"level", "low"}}));
  EXPECT_THAT(run.events, IsEmpty());
}

TEST_P(Answering, AnImpossibleGoalComesBackWithWhatBlocksIt) {
  ask_at(1s, request_for({goal_of("lift", {{"ship", "above"}}), goal_of("flood", {{"quay", "wet"}})}));
  run.run_until(10s);
  EXPECT_EQ(reply(0).verdict_code(), v1::VERDICT_UNSOLVABLE);
  ASSERT_EQ(reply(0).blocking().size(), 1U);
  EXPECT_EQ(reply(0).blocking()[0].issuer(), "ground");
  EXPECT_EQ(reply(0).blocking()[0].id(), "flood");
  EXPECT_EQ(reply(0).blocking()[0].timeline(), "quay");
  EXPECT_EQ(reply(0).blocking()[0].reason(), "no task makes it wet");
}

TEST_P(Answering, AnEngineThatIsNotInTheTableIsToldWithThoseThatAre) {
  v1::PlanRequest request = request_for({});
  request.engine("temporal_pddl");
  ask_at(1s, request);
  run.run_until(10s);
  EXPECT_EQ(reply(0).verdict_code(), v1::VERDICT_UNSUPPORTED);
  EXPECT_EQ(reply(0).reason(), "unknown engine 'temporal_pddl'; this planner has: search");
}

TEST_P(Answering, ACallThatIsCancelledInItsMiddleEndsAtOnceAndTheNextIsAnswered) {
  int asked = 0;
  own_pumps([&](const auto& responder) {
    if (++asked == 1) {
      planner.cancel(newest);
    } else {
      responder.reply(pump_time(250));
    }
  });
  const v1::PlanRequest request =
      request_for({goal_of("full", {{"level", "high"}})}, kAtRest, model_that_asks());
  ask_at(1s, request);
  ask_at(10s, request);
  run.run_until(30s);
  EXPECT_EQ(reply(0).verdict_code(), v1::VERDICT_CANCELLED);
  EXPECT_LT(replies[0].time, 2s);
  EXPECT_EQ(tasks_of(reply(1).solution()), "fill");
  EXPECT_EQ(reply(1).solution().activities().at(0).duration_upper_us(), 250'000'000);
  EXPECT_EQ(asked, 2);
}

TEST_P(Answering, KilledInTheMiddleOfACallItAnswersTheNextOneAfterItsRestart) {
  int asked = 0;
  own_pumps([&](const auto& responder) {
    if (++asked == 1) {
      run.kill_and_restart();
    } else {
      responder.reply(pump_time(250));
    }
  });
  const v1::PlanRequest request =
      request_for({goal_of("full", {{"level", "high"}})}, kAtRest, model_that_asks());
  ask_at(1s, request);
  run.node().on_peer_change([&](const services::health::PeerChange& change) {
    if (change.alive && asked == 1) ask_at(run.node().now(), request);
  });
  run.run_until(3000s);
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].result.status, CallStatus::owner_lost) << replies[0].result.reason;
  EXPECT_EQ(tasks_of(reply(1).solution()), "fill")
      << to_string(replies[1].result.status) << " " << replies[1].result.reason << reply(1).reason();
  EXPECT_EQ(asked, 2);
}

INSTANTIATE_TEST_SUITE_P(Transports, Answering, ::testing::ValuesIn(kPairings),
                         [](const auto& pairing) { return pairing.param.name; });

}  // namespace
}  // namespace roci::planner::proof
