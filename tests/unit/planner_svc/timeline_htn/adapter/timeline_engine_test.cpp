// Requests and answers of the engine: states as they are observed, goals as conditions, verdicts with reasons.
#include "planner_svc/timeline_htn/adapter/timeline_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/temporal/network_distances.hpp"
#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/windows.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::adapter {
namespace {

using engine::Answer, engine::Request;
using temporal::ConditionOp, temporal::seconds, temporal::state, temporal::Verdict;
using testing::HasSubstr, testing::SizeIs, testing::StartsWith;

Request greenhouse() {
  Request out;
  out.engine = "timeline_htn";
  out.origin = seconds(1000);
  out.model = text_of_file("tests/missions/greenhouse/domain.yaml") +
              text_of_file("tests/missions/greenhouse/behaviours.yaml");
  const std::string problem = text_of_file("tests/missions/greenhouse/problem.yaml");
  out.problem_text =
      problem.substr(problem.find("objects:"), problem.find("  goals:") - problem.find("objects:"));
  out.problem_text = with(out.problem_text, "initial: {care: idle, base: at(dock), arm: folded, tank: empty}",
                          "initial: {care: idle}");
  out.state = {
      {"base.nav", state("parked", {"well"})}, {"arm.pose", state("folded")}, {"tank.level", state("full")}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "7";
  goal.achieved = temporal::compare("care", ConditionOp::eq, state("tending", {"basil"}));
  out.goals = {goal};
  return out;
}

Answer answer(const Request& request, const Settings& settings = {}, const engine::Limits& limits = {}) {
  engine::NoFunctions functions;
  return TimelineEngine(settings).answer(request, limits, functions);
}

TEST(TimelineEngine, PlansFromWhatIsObserved) {
  const Answer out = answer(greenhouse());
  ASSERT_EQ(out.verdict, Verdict::solved) << out.reason;
  ASSERT_TRUE(out.plan);
  EXPECT_EQ(out.plan->origin, seconds(1000));
  EXPECT_EQ(out.plan->engine, "timeline_htn");
  EXPECT_TRUE(temporal::check(*out.plan).empty());
  for (const auto& activity : out.plan->activities) {
    EXPECT_THAT(activity.id, StartsWith("1000000000/"));
    EXPECT_THAT(activity.goals_served, testing::ElementsAre("ground/7"));
    EXPECT_NE(activity.name, "tank.filling");  // it is full
  }
  EXPECT_GT(out.statistics.evaluated, 0U);
}

TEST(TimelineEngine, ItsPlansPassItsCheckerAndOthersDoNot) {
  const Request request = greenhouse();
  const Answer out = answer(request);
  ASSERT_TRUE(out.plan);
  const checking::TimelineChecker checker;
  EXPECT_THAT(checker.faults({request, {}, *out.plan}), testing::IsEmpty());
  temporal::FlexiblePlan shorter = *out.plan;
  shorter.tokens.pop_back();
  EXPECT_THAT(checker.faults({request, {}, shorter}), testing::Not(testing::IsEmpty()));
}

// The windows of a request take the place of those of the model,
// by the timeline that shows the component, from the origin on.
TEST(TimelineEngine, WindowsOfTheRequestArePlannedWith) {
  Request request;
  request.engine = "timeline_htn";
  request.origin = seconds(1000);
  const std::size_t problem = reading::kWindows.find("problem:");
  request.model = reading::kWindows.substr(0, problem) +
                  "problem:\n  horizon_s: 3600\n  initial: {mission: idle, antenna: silent}\n"
                  "  predicted: {ground: []}\n  goals: {}\n";
  request.state = {{"ground.window", false}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "1";
  goal.achieved = temporal::compare("mission", ConditionOp::eq, state("told", {"first"}));
  request.goals = {goal};
  const Answer none = answer(request);
  EXPECT_EQ(none.verdict, Verdict::unsolvable);
  EXPECT_THAT(none.reason, HasSubstr("antenna.sending(first) waits for ground.seen as predicted"));
  const auto predict = [&](int at, bool open) {
    request.predictions.push_back({"ground.window", seconds(at), open});
    request.predictions.push_back({"air.clear", seconds(at), !open});  // nobody's
  };
  predict(900, true);
  predict(950, false);
  predict(1300, true);
  predict(1350, false);
  predict(1400, true);
  predict(1450, false);
  predict(1450, true);  // one window after the other
  predict(1500, false);
  const Answer out = answer(request);
  ASSERT_TRUE(out.plan) << out.reason;
  const temporal::NetworkDistances network(out.plan->point_count, temporal::all_constraints(*out.plan));
  const auto sending =
      std::ranges::find(out.plan->activities, "antenna.sending(first)", &temporal::PlanActivity::name);
  ASSERT_NE(sending, out.plan->activities.end());
  EXPECT_EQ(network.between(0, sending->start_point).lower, seconds(400));
  EXPECT_EQ(network.between(0, sending->end_point).upper, seconds(500));
  const checking::TimelineChecker checker;
  EXPECT_THAT(checker.faults({request, {}, *out.plan}), testing::IsEmpty());
  Request earlier = request;
  earlier.predictions[8].at = seconds(1390);
  EXPECT_THAT(checker.faults({earlier, {}, *out.plan}),
              testing::Contains(HasSubstr("ground.seen is predicted from 390 s on")));
  request.predictions[4].value = state("dim");
  EXPECT_EQ(answer(request).verdict, Verdict::invalid_input);
  EXPECT_THAT(answer(request).reason, HasSubstr("'ground.window = dim' is predicted, and is no value"));
}

// The window of a mission's goal opens: what is done for it starts no sooner, though its state is one to rest in, which
// may also have come about before.
TEST(TimelineEngine, NothingIsDoneForAGoalBeforeItsWindowOpens) {
  Request request = greenhouse();
  request.goals[0].achieved = temporal::compare("base.nav", ConditionOp::eq, state("parked", {"dock"}));
  request.goals[0].opens = seconds(1500);
  const Answer out = answer(request);
  ASSERT_TRUE(out.plan) << out.reason;
  ASSERT_THAT(out.plan->activities, SizeIs(1));
  const temporal::NetworkDistances network(out.plan->point_count, temporal::all_constraints(*out.plan));
  EXPECT_EQ(network.between(0, out.plan->activities[0].start_point).lower, seconds(500));
  const checking::TimelineChecker checker;
  EXPECT_THAT(checker.faults({request, {}, *out.plan}), testing::IsEmpty());
  Request later = request;
  later.goals[0].opens = seconds(1501);
  EXPECT_THAT(checker.faults({later, {}, *out.plan}), testing::Contains(HasSubstr("may start before 501 s")));
  request.goals[0].opens = seconds(900);
  const Answer open = answer(request);
  ASSERT_TRUE(open.plan) << open.reason;
  const temporal::NetworkDistances now(open.plan->point_count, temporal::all_constraints(*open.plan));
  EXPECT_EQ(now.between(0, open.plan->activities[0].start_point).lower, seconds(0));
}

// What is known of a graph by now closes its edges, for the engine and for its checker.
TEST(TimelineEngine, ARelationMayBeObserved) {
  Request request = greenhouse();
  const Answer before = answer(request);
  request.model = with(request.model, "path: {arguments: [place, place]}",
                       "path: {arguments: [place, place]}\n"
                       "  closed: {arguments: [place, place], observed: {timeline: way, value: closed}}");
  request.model = with(request.model, "where: [\"path(from, to)\"]",
                       "where: [\"path(from, to)\", \"not closed(from, to)\"]");
  request.state.insert(
      {{"way.well.row_a", state("open")}, {"way.well", state("closed")}, {"way.well.moon", state("closed")}});
  const Answer open = answer(request);
  ASSERT_TRUE(open.plan) << open.reason;
  EXPECT_EQ(open.plan->activities.size(), before.plan->activities.size());
  for (const std::string place : {"dock", "row_a", "row_b"})
    for (const std::string end : {"dock", "row_a", "row_b"}) {
      request.state["way.well." + place] = state("closed");
      request.state["way." + place + "." + end] = state("closed");
    }
  EXPECT_EQ(answer(request).verdict, Verdict::unsolvable) << "no edge leaves the well";
  EXPECT_THAT(checking::TimelineChecker().faults({request, {}, *open.plan}),
              testing::Not(testing::IsEmpty()));
}

TEST(TimelineEngine, AGoalMayBeAnObservedValue) {
  Request request = greenhouse();
  request.goals[0].achieved = temporal::compare("base.nav", ConditionOp::eq, state("parked", {"dock"}));
  const Answer out = answer(request);
  ASSERT_EQ(out.verdict, Verdict::solved) << out.reason;
  EXPECT_THAT(out.plan->activities, SizeIs(1));
}

TEST(TimelineEngine, AnErrorThatIsObservedIsMendedFirst) {
  Request request = greenhouse();
  request.state["base.nav"] = state("stuck", {"well"});
  const Answer out = answer(request);
  ASSERT_EQ(out.verdict, Verdict::solved) << out.reason;
  EXPECT_EQ(out.plan->activities[0].name, "free_the_base");
}

TEST(TimelineEngine, WhatIsOutOfReachIsProvedAndNamed) {
  Request request = greenhouse();
  request.goals[0].closes = seconds(1005);
  request.state["base.nav"] = state("parked", {"dock"});
  request.state["tank.level"] = state("empty");
  request.goals[0].achieved = temporal::compare("tank.level", ConditionOp::eq, state("full"));
  const Answer out = answer(request);
  EXPECT_EQ(out.verdict, Verdict::unsolvable);
  EXPECT_THAT(out.reason, HasSubstr("time does not permit"));
  ASSERT_THAT(out.blocking, SizeIs(1));
  EXPECT_EQ(out.blocking[0].issuer, "ground");
  EXPECT_EQ(out.blocking[0].id, "7");
}

TEST(TimelineEngine, WhatDoesNotFitIsNamedWithItsRemedy) {
  Request request = greenhouse();
  request.state.erase("arm.pose");
  EXPECT_EQ(answer(request).verdict, Verdict::invalid_input);
  EXPECT_THAT(answer(request).reason, HasSubstr("it is not known in which state 'arm' is"));
  request = greenhouse();
  request.state["base.nav"] = state("flying");
  EXPECT_THAT(answer(request).reason, HasSubstr("base.nav = flying is no value of its states"));
  request = greenhouse();
  request.goals[0].achieved = temporal::compare("nowhere", ConditionOp::eq, true);
  EXPECT_EQ(answer(request).verdict, Verdict::unsolvable);
  EXPECT_THAT(answer(request).blocking[0].reason, HasSubstr("is no state of a component of the model"));
  request = greenhouse();
  request.goals[0].closes = seconds(900);
  EXPECT_THAT(answer(request).blocking[0].reason, HasSubstr("its window has closed"));
  request = greenhouse();
  request.model += "nonsense: 1\n";
  EXPECT_EQ(answer(request).verdict, Verdict::invalid_input);
  EXPECT_THAT(answer(request).reason, HasSubstr("unknown key 'nonsense'"));
}

TEST(TimelineEngine, BudgetsEndACall) {
  Request request = greenhouse();
  request.work = 2;
  EXPECT_EQ(answer(request).verdict, Verdict::timeout);
  request.work = 0;
  request.memory_bytes = 1;
  EXPECT_EQ(answer(request).verdict, Verdict::out_of_memory);
  request.memory_bytes = 0;
  EXPECT_EQ(answer(request, {}, {.cancelled = [] { return true; }}).verdict, Verdict::cancelled);
  EXPECT_EQ(answer(request, {}, {.out_of_time = [] { return true; }}).verdict, Verdict::timeout);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::adapter
