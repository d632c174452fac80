// A planner call that nobody needs any more ends early, on every transport, and the planner is free for the
// next one: a search that would never end, live; and in the places of a call where simulated time passes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/unit/planner_svc/service/road_planning.hpp"

namespace roci::planner {
namespace {

using namespace std::chrono_literals;
using namespace testing;
using ::testing::ElementsAre;

class CallCancel : public ::testing::TestWithParam<std::pair<const char*, RoadVendors>> {};

std::vector<std::string> answers_of(const RoadPlanning& planning) {
  std::vector<std::string> out;
  for (const TimedReply& reply : planning.replies()) {
    const bool cancelled = reply.result.reply.verdict_code() == v1::VERDICT_CANCELLED;
    out.push_back(std::to_string(reply.time / 1ms) + " " +
                  (cancelled ? "cancelled" : steps_of(reply.result.reply.solution())));
  }
  return out;
}

TEST_P(CallCancel, WhileItWaitsForValues) {
  const services::process::DomainClaim domain;
  RoadPlanning planning(GetParam().second, domain.id());
  planning.owner_answers([&planning](const v1::FunctionRequest& request, auto responder) {
    planning.owner().after(15s, [&planning, responder, request] {
      responder.reply(ten_seconds(request, planning.owner().now()));
    });
  });
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.cancel(3s);
  planning.ask(3s, plan_request(kRoadDomain, road_problem("(at b)")));
  planning.run_until(100s);
  EXPECT_THAT(answers_of(planning), ElementsAre("3000 cancelled", "18500 go a b"));
}

// By the model of how long a call takes, the planner is at work from 1 s to 1.5 s.
TEST_P(CallCancel, WhileItIsAtWork) {
  const services::process::DomainClaim domain;
  RoadPlanning planning(GetParam().second, domain.id());
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.cancel(1200ms);
  planning.ask(1300ms, plan_request(kRoadDomain, road_problem("(at b)")));
  planning.run_until(100s);
  EXPECT_THAT(answers_of(planning), ElementsAre("1200 cancelled", "1800 go a b"));
}

// Two counters that never meet; the planner cannot prove it.
const std::string kEndlessDomain = R"((define (domain endless)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:functions (a) (b))
  (:durative-action one :parameters () :duration (= ?duration 1) :condition ()
    :effect (at end (increase (a) 2)))
  (:durative-action two :parameters () :duration (= ?duration 1) :condition ()
    :effect (at end (increase (b) 2))))
)";
const std::string kEndlessProblem = R"((define (problem never) (:domain endless)
  (:init (= (a) 0) (= (b) 1)) (:goal (= (a) (b))))
)";

TEST_P(CallCancel, WhileItSearchesLive) {
  const services::process::DomainClaim domain;
  const auto node = [&](const std::string& name, const std::string& vendor) {
    services::node::NodeOptions options;
    options.name = name;
    options.vendor = vendor;
    services::transport::TransportOptions transport;
    transport.domain = domain.id();
    transport.participant = name;
    return std::make_unique<services::Node>(options, services::transport::open_transport(vendor, transport));
  };
  const auto client_node = node("client", GetParam().second.client);
  const auto planner_node = node("planner_svc", GetParam().second.planner);
  services::RunSettings settings;
  settings.mission = ROCI_SOURCE_DIR "/missions/planetary";
  const auto planner = make_service(*planner_node, settings);
  const services::Client<v1::PlanRequest, v1::PlanReply> client(*client_node, services::topics::plan_request);
  std::vector<v1::Verdict> verdicts;
  const auto ask = [&](const std::string& domain_text, const std::string& problem) {
    return client.call(plan_request(domain_text, problem), "planner_svc", 1000s,
                       [&](const auto& result) { verdicts.push_back(result.reply.verdict_code()); });
  };
  const auto turn_until = [&](const std::function<bool()>& done) {
    while (!done()) {
      client_node->spin_once(1ms);
      planner_node->spin_once(1ms);
    }
  };
  std::string solvable = kEndlessProblem;
  solvable.replace(solvable.find("(= (b) 1)"), 9, "(= (b) 2)");
  const services::rpc::CallId endless = ask(kEndlessDomain, kEndlessProblem);
  turn_until([&] { return client.statistics().sent > 1 || !verdicts.empty(); });
  ASSERT_THAT(verdicts, ElementsAre()) << "a quarter of a second has passed, it still searches";
  ask(kEndlessDomain, solvable);
  client.cancel(endless);
  turn_until([&] { return verdicts.size() == 2; });
  EXPECT_THAT(verdicts, ElementsAre(v1::VERDICT_CANCELLED, v1::VERDICT_SOLVED));
}

INSTANTIATE_TEST_SUITE_P(Transports, CallCancel, ::testing::ValuesIn(kRoadTransports),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace roci::planner
