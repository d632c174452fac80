// Missions without PDDL: what their files may say, the problems that engines get, and the plans that come back.
#include "tests/unit/exec_svc/timeline_mission.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/temporal/activity_timeline.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec {

using executive::CommandStage;
using mission::Addressee;
using mission::ExecutiveRole;
using mission::MissionModel;
using problem::Problem;
using problem::write_problem;
using reactor::Reactor;
using reactor::ReactorInputs;
using reactor::ReactorOutputs;

namespace {

using temporal::seconds;
using temporal::state;
using temporal::Value;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::hole;
using ::testing::IsEmpty;
using testing::TimelineMissionFile;

std::string texts(const std::vector<reactor::Event>& events) {
  std::string out;
  for (const reactor::Event& event : events) out += event.code + " " + event.text + "\n";
  return out;
}

TEST(TimelineMission, NeedsNoDomainActionsSiteOrArm) {
  TimelineMissionFile file;
  const MissionModel mission = file.read();
  EXPECT_FALSE(mission.has_domain());
  EXPECT_EQ(mission.model_text, "bore takes 60 s\n");
  EXPECT_EQ(mission.planner.engine, "miner");
  EXPECT_EQ(mission.planner.service, "planner.mole");
  ASSERT_EQ(mission.components.size(), 2U);
  EXPECT_EQ(mission.components[0].timeline, "mole.drill");
  EXPECT_EQ(mission.components[0].robot, "mole");
  EXPECT_EQ(file.read({"vole", true, {"mole", "vole"}, false}).components.size(), 1U)
      << "the lamp is the mole's";
}

TEST(TimelineMission, WhatNeedsADomainIsRefusedWithTheRemedy) {
  TimelineMissionFile file;
  EXPECT_THAT(file.fault("up: {}", "up: {facts: [\"(up)\"]}"), HasSubstr("'facts' speaks of a PDDL domain"));
  EXPECT_THAT(file.fault("planner:", "actions: {}\nplanner:"),
              HasSubstr("'actions' speaks of a PDDL domain"));
  EXPECT_THAT(file.fault("{timeline: comm.window", "{fact: \"(w)\", timeline: comm.window"),
              HasSubstr("'fact' speaks of a PDDL domain"));
  EXPECT_THAT(file.fault("    achieved:", "    goal: [\"(done)\"]\n    achieved:"),
              HasSubstr("'goal' speaks of"));
  EXPECT_THAT(file.fault("    achieved:", "    #"), HasSubstr("'achieved' is missing"));
  EXPECT_THAT(file.fault("{engine: miner, ", "{"), HasSubstr("names the engine that plans it"));
  EXPECT_THAT(file.fault("model: model.txt", "domain: model.txt\nmodel: model.txt"), HasSubstr("not both"));
  EXPECT_THAT(file.fault("at_least: 3", "atleast: 3"),
              HasSubstr("unknown key 'atleast'; known here: timeline, is"));
  EXPECT_THAT(file.fault(", at_least: 3", ""), HasSubstr("a condition compares its timeline"));
  EXPECT_THAT(file.fault("mine", "mine", ExecutiveRole{}), HasSubstr("this executive has no robot"));
}

// A planner with such a mission gets everything as timelines, and no text.
TEST(TimelineMission, ProblemsHoldStatePredictionsGoalsAndObjects) {
  TimelineMissionFile file;
  const MissionModel mission = file.read();
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("mole.drill", state("boring", {"h-a"}));
  beliefs.observe("mole.depth", 2.0);
  beliefs.observe("comm.window", false);
  goals::GoalSet goals(mission);
  goals::GoalRequest wish = hole("a");
  wish.importance = goals::GoalClass::optional;
  wish.utility = {1, 0.5};
  wish.priority = 4;
  wish.preferred = seconds(70);
  wish.closes = seconds(500);
  goals.submit(wish, seconds(0));
  const problem::Forecast forecast{{{"mole.drill", state("in", {"h-a"})}}, {{"mole.depth", 1.0}}};
  const Problem problem = write_problem(mission, beliefs, goals, "mine-1", seconds(60), seconds(150),
                                        problem::Reserves::kept, forecast);
  EXPECT_THAT(problem.text, IsEmpty());
  EXPECT_EQ(problem.state.at("mole.drill"), state("in", {"h-a"})) << "as it will be at the origin";
  EXPECT_EQ(problem.state.at("mole.depth"), Value(3.0));
  EXPECT_EQ(problem.state.at("comm.window"), Value(true)) << "it will be open at 150 s";
  ASSERT_EQ(problem.predictions.size(), 3U);
  EXPECT_EQ(problem.predictions[0].at, seconds(200));
  EXPECT_EQ(problem.predictions[0].value, Value(false));
  EXPECT_EQ(problem.predictions[1].at, seconds(300));
  ASSERT_EQ(problem.goals.size(), 1U);
  EXPECT_EQ(temporal::describe(problem.goals[0].achieved), "mole.drill = in(h-a) and mole.depth >= 3");
  EXPECT_EQ(problem.goals[0].utility, (temporal::RankVector{1, 0.5}));
  EXPECT_EQ(problem.goals[0].priority, 4);
  EXPECT_EQ(problem.goals[0].preferred, seconds(70));
  EXPECT_EQ(problem.goals[0].closes, seconds(500));
  ASSERT_EQ(problem.objects.size(), 2U) << "a dynamic one that no state names stays away";
  EXPECT_EQ(problem.objects[1].name, "hole-1");
  ASSERT_EQ(problem.objects[1].properties.size(), 2U) << "of the robot that {robot} stands for";
  EXPECT_EQ(problem.objects[1].properties[0].value, "2.000000");
}

// What is seen counts at the origin, but for a change that is predicted before it.
TEST(TimelineMission, AWindowThatClosesBeforeTheOriginIsClosedThere) {
  TimelineMissionFile file;
  const MissionModel mission = file.read();
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("comm.window", true);
  const goals::GoalSet goals(mission);
  const auto open_at = [&](double now, double origin) {
    return write_problem(mission, beliefs, goals, "mine-1", seconds(now), seconds(origin),
                         problem::Reserves::kept, {})
        .state.at("comm.window");
  };
  EXPECT_EQ(open_at(190, 199), Value(true));
  EXPECT_EQ(open_at(190, 200), Value(false)) << "it is open until then";
  EXPECT_EQ(open_at(190, 299), Value(false));
  EXPECT_EQ(open_at(190, 300), Value(true)) << "the next one opens";
  EXPECT_EQ(open_at(90, 95), Value(true)) << "before it was predicted to open";
  EXPECT_EQ(open_at(210, 220), Value(true)) << "it should have closed, and is seen open";
}

TEST(TimelineMission, ATimelineOfAnObjectNeedsTheRobotThatItNames) {
  TimelineMissionFile file;
  const mission::ExecutiveRole of_all{"", false, {"mole", "vole"}, true};
  EXPECT_THAT(file.fault("{robot}.drill", "mole.drill", of_all),
              HasSubstr("mission.yaml:5:51: '{robot}' stands here, and this executive has no robot"));
}

// Where the executive has no robot of its own, it is that of the goal.
TEST(TimelineMission, AGoalsObjectIsSeenOnTheTimelinesOfItsRobot) {
  TimelineMissionFile file;
  std::string text = testing::kTimelineMission;
  const auto change = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  change("{robot}.depth", "mole.depth");
  change("{robot}.drill", "mole.drill");
  change("{robot}.lamp", "mole.lamp");
  change("planner.{robot}", "planner");
  change(R"(objects: [{name: "{name}"}])",
         R"(objects: [{name: "{name}", properties: {low: {timeline: "{robot}.depth"}}}])");
  file.write(text);
  const MissionModel mission = file.read({"", false, {"mole", "vole"}, true});
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("vole.depth", 7.0);
  goals::GoalSet goals(mission);
  goals::GoalRequest wish = hole("a");
  wish.robot = "vole";
  goals.submit(wish, seconds(0));
  const Problem problem =
      write_problem(mission, beliefs, goals, "mine-1", seconds(60), seconds(60), problem::Reserves::kept, {});
  ASSERT_FALSE(problem.objects.empty());
  ASSERT_EQ(problem.objects[0].properties.size(), 1U);
  EXPECT_EQ(problem.objects[0].properties[0].value, "7.000000");
}

// The engine could not say in which state the drill is, had it not heard of the hole that the state names.
TEST(TimelineMission, AnObjectOutlivesItsGoalWhileAStateNamesIt) {
  TimelineMissionFile file;
  const MissionModel mission = file.read();
  beliefs::Beliefs beliefs(mission);
  goals::GoalSet goals(mission);
  for (const char* id : {"a", "b", "c"}) goals.submit(hole(id), seconds(0));
  goals.set_state({"ground", "a"}, goals::GoalState::achieved, "");
  goals.set_state({"ground", "b"}, goals::GoalState::achieved, "");
  beliefs.observe("mole.drill", state("in", {"h-b"}));
  const Problem problem =
      write_problem(mission, beliefs, goals, "mine-1", seconds(60), seconds(60), problem::Reserves::kept, {});
  std::vector<std::string> names;
  for (const auto& object : problem.objects) names.push_back(object.name);
  EXPECT_THAT(names, ElementsAre("h-b", "h-c", "hole-1"));
}

class TimelineReactor : public ::testing::Test {
 protected:
  ReactorInputs standing() {
    ReactorInputs in;
    in.observations = {{"mole.drill", state("up")}, {"mole.lamp", state("off")}, {"mole.depth", 0.0}};
    return in;
  }

  // A call for the goal is open, with this id.
  std::uint64_t asked() {
    ReactorInputs in = standing();
    in.goals = {hole("a")};
    const ReactorOutputs out = reactor.step(seconds(0), in);
    EXPECT_TRUE(out.call);
    return out.call ? out.call->id : 0;
  }

  static temporal::FlexiblePlan bore() {
    temporal::FlexiblePlan plan;
    temporal::PlanActivity activity;
    activity.id = "first";
    activity.name = "bore";
    activity.owner = "sim_svc";
    activity.subsystem = "drill";
    activity.command_name = "bore";
    activity.arguments = {{"hole", "h-a"}};
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    activity.duration_lower = seconds(50);
    activity.duration_upper = seconds(90);
    activity.pre = temporal::compare("mole.drill", temporal::ConditionOp::eq, state("up"));
    activity.goals_served = {"ground/a"};
    plan.activities = {activity};
    return plan;
  }

  ReactorOutputs answer(std::uint64_t call, temporal::FlexiblePlan plan) {
    ReactorInputs in;
    in.reply = reactor::PlanReply{call, temporal::Verdict::solved, "", {}, std::move(plan)};
    return reactor.step(seconds(1), in);
  }

  TimelineMissionFile file;
  MissionModel mission = file.read();
  Reactor reactor{mission};
};

TEST_F(TimelineReactor, FliesAPlanThatCommandsItself) {
  const std::uint64_t call = asked();
  answer(call, bore());
  const ReactorOutputs out = reactor.step(seconds(5), {});
  ASSERT_EQ(out.commands.size(), 1U);
  EXPECT_EQ(out.commands[0].activity, "p1.1-bore") << "ids of other plans come again";
  EXPECT_EQ(out.commands[0].robot, "mole");
  EXPECT_EQ(out.commands[0].command_name, "bore");
  EXPECT_THAT(out.commands[0].arguments, ElementsAre(temporal::Property{"hole", "h-a"}));
  ReactorInputs done;
  done.acks = {{"p1.1-bore", 1, CommandStage::accepted, "", ""},
               {"p1.1-bore", 1, CommandStage::completed, "", ""}};
  done.observations = {{"mole.drill", state("in", {"h-a"})}};
  reactor.step(seconds(65), done);
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, goals::GoalState::planned)
      << "it is not deep enough";
  ReactorInputs deep;
  deep.observations = {{"mole.depth", 3.0}};
  reactor.step(seconds(66), deep);
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, goals::GoalState::achieved);
}

TEST_F(TimelineReactor, ACommandGetsWhatItsObjectHas) {
  ReactorInputs in = standing();
  in.goals = {hole("a")};
  const std::uint64_t call = reactor.step(seconds(0), in).call->id;
  temporal::FlexiblePlan plan = bore();
  plan.activities[0].arguments = {
      {"hole", "h-a"}, {"width", "hole-1.width"}, {"gear", "2.5"}, {"of", "nobody.depth"}};
  answer(call, plan);
  const ReactorOutputs out = reactor.step(seconds(5), {});
  ASSERT_EQ(out.commands.size(), 1U);
  EXPECT_THAT(out.commands[0].arguments,
              ElementsAre(temporal::Property{"hole", "h-a"}, temporal::Property{"width", "2"},
                          temporal::Property{"gear", "2.5"}, temporal::Property{"of", "nobody.depth"}));
}

TEST_F(TimelineReactor, APropertyThatAnObjectHasNotIsNamed) {
  const std::uint64_t call = asked();
  temporal::FlexiblePlan plan = bore();
  plan.activities[0].arguments = {{"x", "h-a.x"}};
  EXPECT_THAT(texts(answer(call, plan).events),
              HasSubstr("p1.1-bore needs h-a.x for its command, and the object has no such property"));
}

// R135: a state of the abstract layer that the plan has brought about is told, and outlives the process.
TEST_F(TimelineReactor, WhatThePlanBringsAboutUnobservedIsToldAndKept) {
  const std::uint64_t call = asked();
  temporal::FlexiblePlan plan = bore();
  temporal::PlanActivity errand;
  errand.id = "errand";
  errand.name = "boring a hole";
  errand.start_point = plan.point_count++;
  errand.end_point = plan.point_count++;
  errand.impacts = {{"errand", temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, state("boring")},
                    {"errand", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, state("bored")}};
  plan.constraints = {{errand.start_point, plan.activities[0].start_point},
                      {plan.activities[0].end_point, errand.end_point}};
  plan.activities.push_back(errand);
  answer(call, plan);
  const auto told = [](const ReactorOutputs& out) {
    std::vector<std::string> text;
    for (const auto& [timeline, value] : out.concluded)
      text.push_back(timeline + " = " + temporal::to_text(value));
    return text;
  };
  EXPECT_THAT(told(reactor.step(seconds(5), {})), ElementsAre("errand = boring"));
  ReactorInputs done;
  done.acks = {{"p1.1-bore", 1, CommandStage::accepted, "", ""},
               {"p1.1-bore", 1, CommandStage::completed, "", ""}};
  done.observations = {{"mole.drill", state("in", {"h-a"})}, {"mole.depth", 3.0}};
  EXPECT_THAT(told(reactor.step(seconds(65), done)), ElementsAre("errand = bored"));
  const std::map<std::string, Value> kept{{"errand", state("bored")}};
  EXPECT_EQ(reactor.concluded(), kept);
  Reactor restored(mission);
  restored.restore(reactor.snapshot());
  EXPECT_EQ(restored.concluded(), kept);
  ReactorInputs observed;
  observed.observations = {{"errand", state("bored")}};
  restored.step(seconds(70), observed);
  EXPECT_THAT(restored.concluded(), IsEmpty()) << "who observes it knows better";
}

// Plans that are not PDDL reach the executive as the engine made them.
TEST_F(TimelineReactor, ConditionsLevelsAndChoicesStayAsTheEngineMadeThem) {
  const std::uint64_t call = asked();
  temporal::FlexiblePlan plan = bore();
  plan.activities[0].level = "primitive";
  plan.activities[0].parent = "errand";
  plan.activities[0].post = temporal::compare("mole.drill", temporal::ConditionOp::eq, state("in", {"h-a"}));
  plan.activities[0].maintenance =
      temporal::negate(temporal::compare("mole.lamp", temporal::ConditionOp::eq, state("on")));
  temporal::PlanActivity errand;
  errand.id = "errand";
  errand.level = "abstract";
  errand.start_point = plan.point_count++;
  errand.end_point = plan.point_count++;
  temporal::PlanActivity other = plan.activities[0];
  other.id = "instead";
  other.start_point = plan.point_count++;
  other.end_point = plan.point_count++;
  const temporal::Condition failed =
      temporal::compare(temporal::activity_timeline("first"), temporal::ConditionOp::eq, state("failed"));
  other.pre = temporal::any_of({failed, plan.activities[0].maintenance});
  other.skip_if = temporal::negate(failed);
  plan.activities.push_back(errand);
  plan.activities.push_back(other);
  plan.decisions = {{"way", "", {{"one", {"first"}, {}}, {"two", {"instead"}, failed}}, 1}};
  plan.decisions[0].resolver_kind = temporal::ResolverKind::rule;
  answer(call, plan);
  const temporal::FlexiblePlan& taken = reactor.plan();
  ASSERT_EQ(taken.activities.size(), 3U);
  EXPECT_EQ(taken.activities[0].level, "primitive");
  EXPECT_EQ(taken.activities[0].parent, taken.activities[1].id);
  EXPECT_EQ(taken.activities[0].post, plan.activities[0].post);
  EXPECT_EQ(taken.activities[0].maintenance, plan.activities[0].maintenance);
  temporal::Condition renamed = temporal::compare(temporal::activity_timeline(taken.activities[0].id),
                                                  temporal::ConditionOp::eq, state("failed"));
  EXPECT_EQ(taken.activities[2].pre, temporal::any_of({renamed, plan.activities[0].maintenance}));
  EXPECT_EQ(taken.activities[2].skip_if, temporal::negate(renamed));
  ASSERT_EQ(taken.decisions.size(), 1U);
  EXPECT_THAT(taken.decisions[0].choices[1].activities, ElementsAre(taken.activities[2].id));
  EXPECT_EQ(taken.decisions[0].choices[1].rule, renamed);
}

TEST_F(TimelineReactor, APlanForStrangersIsRefusedInWords) {
  const std::uint64_t call = asked();
  temporal::FlexiblePlan plan = bore();
  plan.activities[0].then = {{"lamp_driver", "", "torch", "light", {}, temporal::no_bound}};
  EXPECT_THAT(texts(answer(call, plan).events),
              AllOf(HasSubstr("robot.safe"), HasSubstr("subsystem 'torch' and owner 'lamp_driver'"),
                    HasSubstr("it has: drill of sim_svc, lamp of lamp_driver")));
}

TEST_F(TimelineReactor, APlanForAnotherRobotIsRefused) {
  const std::uint64_t call = asked();
  temporal::FlexiblePlan plan = bore();
  plan.activities[0].robot = "vole";
  EXPECT_THAT(texts(answer(call, plan).events), HasSubstr("robot 'vole' has no such subsystem"));
}

TEST_F(TimelineReactor, GoalsThatTheEngineBlamesGoAlone) {
  ReactorInputs in = standing();
  in.goals = {hole("a"), hole("b")};
  const std::uint64_t call = reactor.step(seconds(0), in).call->id;
  ReactorInputs reply;
  reply.reply = reactor::PlanReply{call,
                                   temporal::Verdict::unsolvable,
                                   "no drill is that long",
                                   {{{"ground", "a"}, "mole.depth", "ends at 2"}},
                                   {}};
  const ReactorOutputs out = reactor.step(seconds(1), reply);
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, goals::GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "b"})->state, goals::GoalState::pending);
  ASSERT_TRUE(out.call);
  EXPECT_EQ(out.call->problem.goals.size(), 1U);
}

TEST_F(TimelineReactor, AGoalForNobodyIsRejectedByTheOneThatAnswers) {
  ReactorInputs in = standing();
  goals::GoalRequest stray = hole("a");
  stray.robot = "";
  goals::GoalRequest unknown = hole("b");
  unknown.robot = "toad";
  in.goals = {stray, unknown};
  reactor.step(seconds(0), in);
  EXPECT_THAT(reactor.goals().find({"ground", "a"})->reason,
              HasSubstr("names no robot, and several are commanded: mole, vole"));
  EXPECT_THAT(reactor.goals().find({"ground", "b"})->reason, HasSubstr("no executive commands robot 'toad'"));
}

TEST(ExecutiveRole, EachGoalHasOneAddressee) {
  const ExecutiveRole mole{"mole", true, {"mole", "vole"}, true};
  const ExecutiveRole vole{"vole", true, {"mole", "vole"}, false};
  EXPECT_EQ(addressee(mole, "mole"), Addressee::this_one);
  EXPECT_EQ(addressee(vole, "mole"), Addressee::another);
  EXPECT_EQ(addressee(mole, ""), Addressee::nobody);
  EXPECT_EQ(addressee(vole, ""), Addressee::another);
  EXPECT_EQ(addressee(mole, "toad"), Addressee::nobody);
  EXPECT_EQ(addressee(vole, "toad"), Addressee::another);
  const ExecutiveRole only{"mole", false, {}, true};
  EXPECT_EQ(addressee(only, ""), Addressee::this_one);
  EXPECT_EQ(addressee(only, "toad"), Addressee::nobody);
  const ExecutiveRole team{"", true, {"mole"}, true};
  EXPECT_EQ(addressee(team, "vole"), Addressee::this_one) << "nobody else commands it";
  EXPECT_EQ(addressee(team, "mole"), Addressee::another);
  EXPECT_EQ(addressee(team, ""), Addressee::nobody);
}

}  // namespace
}  // namespace roci::exec
