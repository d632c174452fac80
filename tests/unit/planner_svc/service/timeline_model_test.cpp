// A model of several files is planned through the service as it was when the mission was read (R134).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "planner_svc/engine_host_service.hpp"
#include "planner_svc/engines.hpp"
#include "planner_svc/settings.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::planner {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

class TimelineModelTest : public ::testing::Test {
 protected:
  TimelineModelTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    for (const auto& one : std::filesystem::directory_iterator(ROCI_SOURCE_DIR "/missions/faster"))
      if (one.path().extension() == ".yaml") std::filesystem::copy(one.path(), folder_);
    std::ofstream(folder_ / "mission.yaml") << "planner: {engine: timeline_htn}\nmodel: problem.yaml\n";
    settings_.mission = folder_;
  }
  ~TimelineModelTest() override { std::filesystem::remove_all(folder_); }

  // A request as an executive sends it: the model as it has read it, where all stands, the long traverse.
  static v1::PlanRequest request(const std::string& model) {
    v1::PlanRequest out;
    out.engine("timeline_htn");
    out.model(model);
    v1::PlanGoal goal;
    goal.issuer("ground");
    goal.id("1");
    goal.achieved() = services::wire::to_wire(
        temporal::compare("mission", temporal::ConditionOp::eq, temporal::state("traversed", {"w9"})));
    out.goals().push_back(goal);
    return out;
  }

  v1::PlanReply reply_to(
      const v1::PlanRequest& request, const std::function<void()>& meanwhile = [] {}) {
    services::SimRun run({"exec", "planner_svc"});
    services::Node& exec = run.add("exec");
    const auto planner = host_engines(run.add("planner_svc"), settings_, engines());
    meanwhile();
    services::Client<v1::PlanRequest, v1::PlanReply> caller(exec, topics::plan_request);
    v1::PlanReply out;
    exec.at(1s, [&] {
      caller.call(request, "planner_svc", 100s, [&](const services::CallResult<v1::PlanReply>& result) {
        EXPECT_EQ(result.status, services::rpc::CallStatus::ok) << result.reason;
        out = result.reply;
        exec.stop();
      });
    });
    run.run();
    return out;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roci-timeline-model-" + std::to_string(getpid()));
  services::RunSettings settings_;
};

std::size_t cycles(const v1::PlanReply& reply) {
  return static_cast<std::size_t>(
      std::ranges::count_if(reply.solution().activities(), [](const v1::PlanActivity& activity) {
        return activity.name().starts_with("navigation.team_cycle(");
      }));
}

TEST_F(TimelineModelTest, AModelOfSeveralFilesIsPlanned) {
  const v1::PlanReply reply = reply_to(request(read_settings(folder_).model));
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(cycles(reply), 9U);
}

// What the executive has read is what counts: neither a planner that starts anew nor a replay sees other files.
TEST_F(TimelineModelTest, FilesThatChangeInFlightChangeNothing) {
  const v1::PlanRequest sent = request(read_settings(folder_).model);
  const v1::PlanReply before = reply_to(sent);
  std::ofstream(folder_ / "behaviours.yaml") << "behaviours: {}\n";
  std::filesystem::remove(folder_ / "yard.yaml");
  std::ofstream(folder_ / "problem.yaml") << "domain: other\n";
  const v1::PlanReply after = reply_to(sent);
  ASSERT_EQ(after.verdict_code(), v1::VERDICT_SOLVED) << after.reason();
  EXPECT_EQ(before.solution().activities(), after.solution().activities());
}

TEST_F(TimelineModelTest, AFaultIsToldWithTheFileThatHasIt) {
  std::ofstream(folder_ / "yard.yaml", std::ios::app) << "nonsense: 1\n";
  const v1::PlanReply reply = reply_to(request(read_settings(folder_).model));
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_INVALID_INPUT);
  EXPECT_THAT(reply.reason(), HasSubstr("yard.yaml:"));
  EXPECT_THAT(reply.reason(), HasSubstr("unknown key 'nonsense'"));
  std::filesystem::remove(folder_ / "yard.yaml");
  EXPECT_THROW(read_settings(folder_), std::exception);
}

// R132: the mission says which resolvers search, and on how many threads; the plan is the same for any number of these.
TEST_F(TimelineModelTest, TheMissionNamesResolversAndThreads) {
  const auto with_planner = [&](const std::string& words) {
    std::ofstream(folder_ / "mission.yaml")
        << "model: problem.yaml\nplanner: {engine: timeline_htn" + words + "}\n";
    return reply_to(request(read_settings(folder_, engines()).model));
  };
  const v1::PlanReply alone = with_planner("");
  const v1::PlanReply one = with_planner(", resolvers: [blind, landmarks], threads: 1");
  const v1::PlanReply two = with_planner(", resolvers: [blind, landmarks], threads: 2");
  ASSERT_EQ(two.verdict_code(), v1::VERDICT_SOLVED) << two.reason();
  EXPECT_EQ(one.solution().activities(), two.solution().activities());
  EXPECT_EQ(one.statistics().evaluated(), two.statistics().evaluated());
  EXPECT_GT(one.statistics().evaluated(), alone.statistics().evaluated()) << "both have searched";
  const auto fault = [&](const std::string& planner) -> std::string {
    std::ofstream(folder_ / "mission.yaml") << "planner: {" + planner + "}\n";
    try {
      read_settings(folder_, engines());
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault("engine: timeline_htn, resolvers: [blind, clever]"),
              HasSubstr("mission.yaml:1:52: engine 'timeline_htn' has no resolver 'clever'; write some of "
                        "blind, blind_last"));
  EXPECT_THAT(fault("engine: temporal_pddl, resolvers: [blind]"),
              HasSubstr("has no resolvers to choose from"));
  EXPECT_THAT(fault("engine: timeline_htn, resolvers: []"), HasSubstr("there is no resolver in it"));
  EXPECT_THAT(fault("engine: timeline_htn, threads: 0"), HasSubstr("a search runs on 1 to 64 threads"));
  EXPECT_EQ(fault("engine: utility_htn, resolvers: [earliest, anytime]"), "");
  EXPECT_THAT(fault("engine: utility_htn, resolvers: [anytime, robust]"),
              HasSubstr("mission.yaml:1:43: 'anytime' and 'robust' are two ways to search; name one of them"));
  EXPECT_THAT(fault("engine: utility_htn, resolvers: [nearest, earliest]"), HasSubstr("are two schedulers"));
}

const std::string kGate = R"yaml(domain: gate
types: [side]
objects: {side: [left, right]}
components:
  tour:
    layer: abstract
    states: {idle: {kind: default}, go: {kind: complex}, gone: {kind: default, observed: {timeline: tour}}}
    transitions: [idle -> go, go -> gone]
  base:
    layer: primitive
    states:
      here: {kind: default}
      pass: {kind: simple, parameters: {by: side}, duration_s: 5, command: {owner: o, component: b, command: pass, arguments: {by: by}}, needs: ["at_start gate.open(by)"]}
    transitions: ["here <-> pass(x)"]
  gate:
    layer: primitive
    states: {open: {kind: default, parameters: {side: side}, observed: {timeline: gate}}}
    transitions: []
behaviours:
  go: {achieves: tour.go, variables: {side: side}, subgoals: {pass: base.pass(side)}, decisions: {side: {resolver: engine, before: pass.start, binds: side}}}
problem:
  horizon_s: 100
  initial: {tour: idle, base: here, gate: open(left)}
)yaml";

// R131: the plan's decision is answered by the engine that made it, once the gate is seen.
TEST_F(TimelineModelTest, ADecisionOfTheEngineIsAnsweredWhenTheInformationIsThere) {
  std::ofstream(folder_ / "problem.yaml") << kGate;
  v1::PlanRequest sent = request(kGate);
  sent.goals()[0].achieved() =
      services::wire::to_wire(temporal::compare("tour", temporal::ConditionOp::eq, temporal::state("gone")));
  v1::Plan plan = reply_to(sent).solution();
  ASSERT_EQ(plan.decisions().size(), 1U);
  plan.executive("exec");
  services::SimRun run({"exec", "planner_svc"});
  services::Node& exec = run.add("exec");
  const auto planner = host_engines(run.add("planner_svc"), settings_, engines());
  const auto plans = services::advertise(exec, topics::plan);
  const auto questions = services::advertise(exec, topics::decision);
  const auto observations = services::advertise(exec, topics::observation);
  std::vector<std::string> heard;
  services::subscribe(exec, topics::decision_answer, [&](const v1::DecisionAnswer& answer) {
    heard.push_back(std::to_string(exec.now() / 1s) + " " + answer.decision_id() + " " +
                    answer.bound_value());
  });
  exec.at(1s, [&] {
    plans.write(plan);
    v1::Decision question;
    question.executive("exec");
    question.id(plan.decisions()[0].id());
    question.resolver("timeline_htn");
    question.answer_before_us(90'000'000);
    question.decision_state(v1::DECISION_OPEN);
    questions.write(question);
  });
  exec.at(7s, [&] {
    v1::Observation seen;
    seen.timeline("gate");
    seen.observed() = services::wire::to_wire(temporal::Value(temporal::state("open", {"right"})));
    observations.write(seen);
  });
  exec.at(20s, [&] { exec.stop(); });
  run.run();
  EXPECT_THAT(heard, ::testing::ElementsAre("7 " + plan.decisions()[0].id() + " right"));
}

}  // namespace
}  // namespace roci::planner
