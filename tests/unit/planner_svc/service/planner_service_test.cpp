// The planner as a service: what comes back for a request, and that nothing keeps it from the next one.
#include "planner_svc/planner_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "planner_svc/settings.hpp"
#include "tests/unit/planner_svc/service/road_planning.hpp"

namespace roci::planner {
namespace {

using namespace std::chrono_literals;
using namespace testing;
using services::rpc::CallStatus;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The one reply to one request at 1 s.
v1::PlanReply reply_to(RoadPlanning& planning, const v1::PlanRequest& request) {
  planning.ask(1s, request);
  planning.run_until(100s);
  if (planning.replies().size() != 1U) {
    ADD_FAILURE() << planning.replies().size() << " replies";
    return {};
  }
  EXPECT_EQ(planning.replies()[0].result.status, CallStatus::ok) << planning.replies()[0].result.reason;
  return planning.replies()[0].result.reply;
}

v1::FunctionReply without_the_direct_road(const v1::FunctionRequest& request, temporal::Time now) {
  v1::FunctionReply reply = ten_seconds(request, now);
  reply.results()[0].outcomes()[2] = v1::FUNCTION_UNREACHABLE;  // a c
  return reply;
}

TEST(PlannerSettings, TheMissionSaysWhatBetterPlansMayCost) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("roci_improvement_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto read = [&](const std::string& budget) {
    std::ofstream(folder / "mission.yaml") << "planner: {budget: {" + budget + "}}\n";
    return read_settings(folder).improvement;
  };
  EXPECT_EQ(read("work: 4000"), engine::kImprovement);
  EXPECT_EQ(read("work: 4000, improvement: 0"), 0U);
  EXPECT_EQ(read("improvement: 250"), 250U);
  EXPECT_ANY_THROW(read("improvement: -1"));
  EXPECT_ANY_THROW(read("improvement: 2.5"));
  std::filesystem::remove_all(folder);
}

TEST(PlannerService, AnswersWithPlanNetworkVerdictAndStatistics) {
  RoadPlanning planning;
  const v1::PlanReply reply = reply_to(planning, plan_request(kRoadDomain, road_problem("(and (at b))")));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(reply.solution().engine(), "temporal_pddl");
  EXPECT_EQ(steps_of(reply.solution()), "go a b");
  const v1::PlanActivity& activity = reply.solution().activities().at(0);
  EXPECT_EQ(activity.duration_lower_us(), 10'000'000);
  EXPECT_EQ(activity.duration_upper_us(), 10'000'000);
  EXPECT_NE(activity.start_point(), activity.end_point());
  EXPECT_EQ(reply.solution().point_count(), 3U) << "the origin, its start, its end";
  EXPECT_EQ(reply.statistics().function_tuples(), 9U) << "all typed tuples, once (R37)";
  EXPECT_GT(reply.statistics().evaluated(), 0U);
  EXPECT_GT(reply.statistics().peak_rss_kb(), 0U);
  EXPECT_EQ(planning.replies()[0].time, 1500ms) << "by the stated model of how long a call takes";
  EXPECT_THAT(planning.events(), IsEmpty());
}

// What the mission spends on better plans is what a call spends: no number of the planner's own.
TEST(PlannerService, SpendsOnBetterPlansWhatTheMissionSays) {
  const auto evaluated = [](const std::string& improvement) {
    RoadPlanning planning({}, services::next_domain(), true, "eager, budget: {improvement: " + improvement + "}");
    const v1::PlanReply reply = reply_to(planning, plan_request(kRoadDomain, road_problem()));
    EXPECT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
    return reply.statistics().evaluated();
  };
  const auto none = evaluated("0"), few = evaluated("3");
  EXPECT_LT(none, few);
  EXPECT_LE(few, none + 3);
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// R41: what the planner was given and what it answered stands in the run's folder.
TEST(PlannerService, KeepsEachCallSoThatItCanBeMadeAgain) {
  RoadPlanning planning;
  planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
    responder.reply(without_the_direct_road(request, planning.owner().now()));
  });
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.ask(10s, plan_request(kRoadDomain, road_problem("(and (at b) (at c))")));
  planning.run_until(100s);
  const std::filesystem::path folder = planning.run_folder() / "planner_calls";
  EXPECT_EQ(content_of(folder / "1.pddl"), road_problem());
  EXPECT_THAT(content_of(folder / "1.values"),
              AllOf(HasSubstr("(travel_time a b) 10\n"), HasSubstr("(travel_time a c) unreachable\n")));
  EXPECT_THAT(content_of(folder / "1.json"), HasSubstr("\"verdict\": \"solved\""));
  EXPECT_THAT(content_of(folder / "2.json"), HasSubstr("\"verdict\": \"unsolvable\""));
}

TEST(PlannerService, TheNetworkOrdersWhatDependsOnEachOther) {
  RoadPlanning planning;
  planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
    responder.reply(without_the_direct_road(request, planning.owner().now()));
  });
  const v1::Plan plan = reply_to(planning, plan_request(kRoadDomain, road_problem())).solution();
  ASSERT_EQ(steps_of(plan), "go a b, go b c");
  const bool ordered = std::ranges::any_of(plan.constraints(), [&](const v1::TemporalConstraint& constraint) {
    return constraint.from_point() == plan.activities()[0].end_point() &&
           constraint.to_point() == plan.activities()[1].start_point() && constraint.lower_us() > 0;
  });
  EXPECT_TRUE(ordered) << "the second starts after the first has ended";
}

TEST(PlannerService, AMalformedDomainIsToldWithItsPlace) {
  RoadPlanning planning;
  std::string domain = kRoadDomain;
  domain.replace(domain.find("(at ?p - place)"), 15, "(at ?p - plaice)");
  const v1::PlanReply reply = reply_to(planning, plan_request(domain, road_problem()));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_INVALID_INPUT);
  EXPECT_THAT(reply.reason(), AllOf(HasSubstr("domain:4:"), HasSubstr("plaice")));
  EXPECT_TRUE(reply.solution().activities().empty());
  ASSERT_EQ(planning.events().size(), 1U);
  EXPECT_EQ(planning.events()[0].code(), "planner.verdict");
  EXPECT_THAT(planning.events()[0].text(), HasSubstr("domain:4:"));
}

TEST(PlannerService, WhatDepartsFromPddlIsReadAndToldOnce) {
  RoadPlanning planning;
  std::string domain = kRoadDomain;
  domain.replace(domain.find("(at ?p - place)"), 15, "(at ?p - place),");
  planning.ask(1s, plan_request(domain, road_problem()));
  planning.ask(20s, plan_request(domain, road_problem()));
  planning.run_until(100s);
  ASSERT_EQ(planning.replies().size(), 2U);
  for (const TimedReply& timed : planning.replies())
    EXPECT_EQ(timed.result.reply.verdict_code(), v1::VERDICT_SOLVED) << timed.result.reply.reason();
  ASSERT_EQ(planning.events().size(), 1U);
  EXPECT_EQ(planning.events()[0].code(), "planner.warning");
  EXPECT_THAT(planning.events()[0].text(), AllOf(HasSubstr("domain:4:"), HasSubstr("[comma]")));
}

TEST(PlannerService, WhatIsNotSupportedIsNotCalledInvalid) {
  RoadPlanning planning;
  std::string domain = kRoadDomain;
  domain.insert(domain.rfind(')'), "(:constraints (always (at a)))");
  const v1::PlanReply reply = reply_to(planning, plan_request(domain, road_problem()));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_UNSUPPORTED);
  EXPECT_THAT(reply.reason(), HasSubstr("trajectory constraints"));
}

TEST(PlannerService, AMalformedProblemIsToldWithItsPlace) {
  RoadPlanning planning;
  const v1::PlanReply reply = reply_to(planning, plan_request(kRoadDomain, road_problem("(at nowhere)")));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_INVALID_INPUT);
  EXPECT_THAT(reply.reason(), AllOf(HasSubstr("problem:4:"), HasSubstr("nowhere")));
}

TEST(PlannerService, AnUnknownModuleIsToldWithItsPlaceAndWhatThereIs) {
  RoadPlanning planning;
  std::string domain = kRoadDomain;
  domain.replace(domain.find(":module roads"), 13, ":module raods");
  const v1::PlanReply reply = reply_to(planning, plan_request(domain, road_problem()));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_FUNCTION_UNAVAILABLE);
  EXPECT_THAT(reply.reason(), AllOf(HasSubstr("domain:5:"), HasSubstr("no service offers module 'raods'"),
                                    HasSubstr("offered are: roads")));
  EXPECT_EQ(planning.requests_for_values(), 0);
}

TEST(PlannerService, AnUnknownEngineIsToldWithThoseItHas) {
  RoadPlanning planning;
  v1::PlanRequest request = plan_request(kRoadDomain, road_problem());
  request.engine("crystal_ball");
  const v1::PlanReply reply = reply_to(planning, request);
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_UNSUPPORTED);
  EXPECT_THAT(reply.reason(), AllOf(HasSubstr("crystal_ball"), HasSubstr("temporal_pddl")));
}

// "go a b" for each.
v1::PlanRequest request_with_remaining(const std::vector<std::string>& actions) {
  v1::PlanRequest request = plan_request(kRoadDomain, road_problem());
  for (const std::string& action : actions) {
    std::istringstream words(action);
    v1::RemainingAction remaining;
    words >> remaining.name();
    for (std::string object; words >> object;) remaining.arguments().push_back(object);
    remaining.start_us(10'000'000 * static_cast<std::int64_t>(request.remaining().size()));
    remaining.duration_us(9'000'000);
    request.remaining().push_back(std::move(remaining));
  }
  return request;
}

TEST(PlannerService, BeginsWithWhatRemainsOfAnEarlierPlan) {
  RoadPlanning planning;
  planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
    responder.reply(without_the_direct_road(request, planning.owner().now()));
  });
  const v1::PlanReply reply = reply_to(planning, request_with_remaining({"go a b", "go b c"}));
  EXPECT_EQ(steps_of(reply.solution()), "go a b, go b c");
  EXPECT_TRUE(reply.statistics().from_remaining());
  const std::filesystem::path folder = planning.run_folder() / "planner_calls";
  EXPECT_EQ(content_of(folder / "1.remaining"), "0.000: (go a b) [9.000]\n10.000: (go b c) [9.000]\n");
  EXPECT_THAT(content_of(folder / "1.json"), HasSubstr("\"from_remaining\": true"));
}

TEST(PlannerService, WhatRemainsIsNoReasonForAWorsePlan) {
  RoadPlanning planning;  // where all roads take 10 s
  const v1::PlanReply reply = reply_to(planning, request_with_remaining({"go a b", "go b a", "go a c"}));
  EXPECT_EQ(steps_of(reply.solution()), "go a c");
}

TEST(PlannerService, ARemainingPlanThatFitsNothingDoesNoHarm) {
  v1::PlanRequest out_of_time = request_with_remaining({"go a c", "go a c", "go a c"});
  out_of_time.remaining()[0].start_us(std::numeric_limits<std::int64_t>::max());
  out_of_time.remaining()[1].duration_us(std::numeric_limits<std::int64_t>::max());
  out_of_time.remaining()[2].start_us(-1);
  const std::vector<v1::PlanRequest> stale = {
      request_with_remaining({}),
      request_with_remaining({"fly a c"}),
      request_with_remaining({"go a nowhere", "go d c"}),
      request_with_remaining({"go", "go a b c", " ", "(go a c) [1]\n;", "GO A C"}),
      out_of_time,
  };
  for (const v1::PlanRequest& request : stale) {
    RoadPlanning planning;
    const v1::PlanReply reply = reply_to(planning, request);
    EXPECT_EQ(steps_of(reply.solution()), "go a c");
    EXPECT_FALSE(reply.statistics().from_remaining());
  }
}

TEST(PlannerService, OfAnEndlessRemainingPlanTheBeginningIsTaken) {
  std::vector<std::string> to_and_fro;
  for (int i = 0; i < 20'000; ++i) to_and_fro.push_back(i % 2 == 0 ? "go a b" : "go b a");
  RoadPlanning planning;
  const v1::PlanReply reply = reply_to(planning, request_with_remaining(to_and_fro));
  EXPECT_EQ(steps_of(reply.solution()), "go a c");
}

TEST(PlannerService, ASpentBudgetOfWorkIsATimeout) {
  // Each of the goals alone is within reach, so that it takes more than one look to see that both are not.
  RoadPlanning planning;
  planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
    responder.reply(without_the_direct_road(request, planning.owner().now()));
  });
  v1::PlanRequest request = plan_request(kRoadDomain, road_problem("(and (at b) (at c))"));
  request.budget().work(1);
  EXPECT_EQ(reply_to(planning, request).verdict_code(), v1::VERDICT_TIMEOUT);
}

TEST(PlannerService, AnswersRequestsOneAfterTheOtherInTheirOrder) {
  RoadPlanning planning;
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.ask(1s, plan_request("(nonsense", road_problem()));
  planning.ask(1s, plan_request(kRoadDomain, road_problem("(at b)")));
  planning.ask(50s, plan_request(kRoadDomain, road_problem()));
  planning.run_until(100s);
  std::vector<std::string> answers;
  for (const TimedReply& reply : planning.replies())
    answers.push_back(std::to_string(reply.time / 1ms) + " " + steps_of(reply.result.reply.solution()));
  EXPECT_THAT(answers, ElementsAre("1500 go a c", "2000 ", "2500 go a b", "50500 go a c"));
  EXPECT_EQ(planning.replies()[1].result.reply.verdict_code(), v1::VERDICT_INVALID_INPUT);
}

// Two clients: one dies while its call waits for values and another of its calls is queued.
TEST(PlannerService, ACallOfADeadClientIsCancelledAndTheNextOneAnswered) {
  services::SimRun run({"client", "planner_svc", "roads_svc", "mortal"});
  services::Node& client = run.add("client");
  services::Node& owner = run.add("roads_svc");
  services::Node& mortal = run.add("mortal");
  services::RunSettings settings;
  settings.mission = ROCI_SOURCE_DIR "/missions/planetary";
  const auto service = make_service(run.add("planner_svc"), settings);
  v1::FunctionOffer offer;
  offer.module_name("roads");
  offer.owner("roads_svc");
  services::advertise(owner, services::topics::function_offer).write(offer);
  int asked = 0;
  services::serve(owner, services::topics::function_call,
                  [&](const v1::FunctionRequest& request, auto responder) {
                    if (++asked > 1) responder.reply(ten_seconds(request, owner.now()));
                  });
  const services::Client<v1::PlanRequest, v1::PlanReply> dying(mortal, services::topics::plan_request);
  const services::Client<v1::PlanRequest, v1::PlanReply> living(client, services::topics::plan_request);
  mortal.at(1s, [&] {
    for (int i = 0; i < 2; ++i)
      dying.call(plan_request(kRoadDomain, road_problem()), "planner_svc", 1000s, [](const auto&) {});
  });
  mortal.at(3s, [] { throw services::Crash{}; });
  std::vector<std::string> answers;
  client.at(2s, [&] {
    living.call(
        plan_request(kRoadDomain, road_problem()), "planner_svc", 1000s,
        [&](const services::CallResult<v1::PlanReply>& result) {
          answers.push_back(std::to_string(client.now() / 1s) + " " + steps_of(result.reply.solution()));
        });
  });
  std::vector<std::string> events;
  services::subscribe(client, services::topics::event,
                      [&](const v1::Event& event) { events.push_back(event.text()); });
  client.at(100s, [&client] { client.stop(); });
  run.run();
  EXPECT_THAT(answers, ElementsAre("3 go a c"))
      << "at once, not after the 20 s that the dead one's would take";
  EXPECT_EQ(asked, 2) << "the dead client's second call is never begun";
  EXPECT_THAT(events, IsEmpty());
}

// At 5.000 s a newer call waits behind one that waits for values.
TEST(PlannerService, ACallThatIsCancelledWhileItIsQueuedIsNeverBegun) {
  RoadPlanning planning;
  planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
    planning.owner().after(9s, [&planning, responder, request] {
      responder.reply(ten_seconds(request, planning.owner().now()));
    });
  });
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.ask(2s, plan_request(kRoadDomain, road_problem("(at b)")));
  planning.cancel(5s);
  planning.run_until(100s);
  ASSERT_EQ(planning.replies().size(), 2U);
  EXPECT_EQ(planning.replies()[0].time, 5s);
  EXPECT_EQ(planning.replies()[0].result.reply.verdict_code(), v1::VERDICT_CANCELLED);
  EXPECT_EQ(steps_of(planning.replies()[1].result.reply.solution()), "go a c");
  EXPECT_EQ(planning.requests_for_values(), 1);
}

// The thread of a call waits for values for ever: the service still ends.
TEST(PlannerService, EndsWhileACallIsUnderWay) {
  RoadPlanning planning;
  planning.owner_answers([](const v1::FunctionRequest&, auto) {});
  planning.ask(1s, plan_request(kRoadDomain, road_problem()));
  planning.run_until(2s);
  EXPECT_EQ(planning.requests_for_values(), 1);
  EXPECT_THAT(planning.replies(), IsEmpty());
}

}  // namespace
}  // namespace roci::planner
