// Plans of an engine that plans all the time: versions come as deltas while what is committed is executed.
#include <random>
#include <set>

#include "exec_svc/reactor/commitment.hpp"
#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAction;
using goals::GoalRequest;
using mission::Replanning;
using reactor::MissionPhase;
using reactor::PlanReceipt;
using reactor::Reactor;
using reactor::ReactorInputs;

namespace {

using temporal::CommitState;
using temporal::PlanActivity;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

// The engine's next plan, in seconds of mission time. Points keep their numbers.
class Engine : public PlanBuilder {
 public:
  Engine() { plan.engine = "scripted"; }

  // An image of a goal of the ground, 40 s.
  void image(const std::string& id, CommitState commit, double not_before = 0, double not_after = 10000) {
    PlanActivity& added = activity(id, "sim_svc", 40);
    added.subsystem = "camera";
    added.command_name = "image";
    added.arguments = {{"image", "image-" + id}};
    added.goals_served = {"ground/" + id};
    added.commit = commit;
    window(start(id), not_before, not_after);
  }
  PlanActivity& find(const std::string& id) {
    return *std::ranges::find(plan.activities, id, &PlanActivity::id);
  }
  void remove(const std::string& id) {
    const temporal::TimePoint from = start(id), to = end(id);
    std::erase_if(plan.constraints, [&](const temporal::TemporalConstraint& constraint) {
      return constraint.to_point == from || constraint.to_point == to || constraint.from_point == from ||
             constraint.from_point == to;
    });
    std::erase_if(plan.activities, [&](const PlanActivity& one) { return one.id == id; });
  }
  void forget(const std::string& id) {
    if (std::ranges::find(plan.activities, id, &PlanActivity::id) != plan.activities.end()) remove(id);
  }
  temporal::PlanDelta delta(bool whole = false) {
    ++plan.version;
    temporal::PlanDelta out = difference(whole ? temporal::FlexiblePlan{} : told_, plan);
    told_ = plan;
    return out;
  }
  void take_back(const temporal::FlexiblePlan& plan_told) { told_ = plan_told; }
  const temporal::FlexiblePlan& told() const { return told_; }

 private:
  temporal::FlexiblePlan told_;
};

class ContinuousPlanning : public ReactorTest {
 protected:
  ContinuousPlanning() {
    mission.executive.replanning = Replanning::continuous;
    mission.planner.engine = "scripted";
    reactor = Reactor(mission);
  }

  ReactorInputs with_plan(ReactorInputs inputs) {
    inputs.deltas.push_back(engine.delta());
    return inputs;
  }
  void at(double time_s, std::function<void()> what) {
    other_events.emplace(seconds(time_s), std::move(what));
  }
  void send_at(double time_s, std::function<void()> change) {
    at(time_s, [this, change] {
      change();
      pending.deltas.push_back(engine.delta());
    });
  }
  std::vector<std::string> begun() const {
    std::vector<std::string> out;
    for (const Command& command : commands)
      if (command.action == CommandAction::execute && command.command_name == "image")
        out.push_back(command.activity);
    return out;
  }

  Engine engine;
};

TEST_F(ContinuousPlanning, WhatIsCommittedStartsAndTheRestWaitsForItsCommit) {
  engine.image("1", CommitState::committed);
  engine.image("2", CommitState::planned, 0, 60);
  send_at(200, [this] {
    engine.find("2").commit = CommitState::committed, engine.window(engine.start("2"), 0, 9000);
  });
  engine.plan.constraints.erase(engine.plan.constraints.begin() + 1);
  run(190, with_plan(robot_and({photo("1"), photo("2")})));
  EXPECT_THAT(begun(), ElementsAre("1"));
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  run(1000, {});
  EXPECT_THAT(begun(), ElementsAre("1", "2"));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().planner_calls, 0U);
}

// A load that is always on and a wait that nothing ends hold no mission open whose goals are achieved;
// what a command runs ends by itself.
TEST_F(ContinuousPlanning, APlanEndsWithTheLastGoalAndWhatRunsByCommand) {
  engine.image("1", CommitState::committed);
  engine.activity("load", "", 1e6).commit = CommitState::committed;
  PlanActivity& sends = engine.activity("sends", "sim_svc", 10, 1e6);
  sends.subsystem = "radio";
  sends.command_name = "send";
  sends.commit = CommitState::committed;
  PlanActivity& waits = engine.activity("waits", "", 1);
  waits.commit = CommitState::committed;
  engine.window(engine.start("waits"), 5e5, 1e6);
  engine.image("next", CommitState::committed, 500);
  at(700, [this] { pending.acks.push_back({"sends", 1, executive::CommandStage::completed, "", ""}); });
  run(600, with_plan(robot_and({photo("1")})));
  EXPECT_EQ(reactor.goals().find({"ground", "1"})->state, goals::GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "") << "a command is under way";
  EXPECT_THAT(begun(), ElementsAre("1", "next")) << "what is committed is carried out";
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_THAT(trace, AllOf(Contains("plan.finished"), Not(Contains("cancel"))));
}

// A command behind a wait that nothing ends would hold the mission open, too.
TEST_F(ContinuousPlanning, APlanEndsThoughWhatIsCommittedWaitsForWhatNeverComes) {
  engine.image("1", CommitState::committed);
  PlanActivity& waits = engine.activity("waits", "", 1);
  waits.pre = temporal::compare("rover.camera", temporal::ConditionOp::eq, state("gone"));
  waits.wait_timeout = seconds(1e6);
  waits.commit = CommitState::committed;
  waits.preferred_start = seconds(300);
  engine.image("next", CommitState::committed);
  engine.find("next").preferred_start = seconds(301);
  engine.after("waits", "next");
  run(350, with_plan(robot_and({photo("1")})));
  EXPECT_EQ(reactor.outcome(), "") << "its time has just come";
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_THAT(begun(), ElementsAre("1"));
}

// What the ground has set counts until an activity makes something else of it,
// whatever versions come and whoever asks for it again.
TEST_F(ContinuousPlanning, AnActivityChangesWhatTheGroundHasSet) {
  mission.ground.values = {"hold"};
  reactor = Reactor(mission);
  const auto clear = [this](const std::string& id) {
    orders::Order order;
    order.key = {"ground", id};
    order.kind = orders::OrderKind::set_value;
    order.target = "hold";
    order.content = state("clear");
    pending.ground_orders.push_back(order);
  };
  PlanActivity& holds = engine.activity("holds", "", 10);
  holds.commit = CommitState::committed;
  holds.impacts = {{"hold", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, state("held")}};
  engine.window(engine.start("holds"), 100);
  engine.image("1", CommitState::committed, 200);
  engine.find("1").pre = temporal::compare("hold", temporal::ConditionOp::eq, state("clear"));
  engine.find("1").wait_timeout = seconds(1e4);
  at(50, [&] { clear("first"); });
  send_at(150, [this] { engine.image("2", CommitState::planned, 5000); });
  run(400, with_plan(robot_and({photo("1")})));
  EXPECT_THAT(begun(), IsEmpty());
  EXPECT_EQ(reactor.ground_values().at("hold"), temporal::Value(state("held")));
  at(500, [&] { clear("second"); });
  run(600, {});
  EXPECT_THAT(begun(), ElementsAre("1"));
}

TEST_F(ContinuousPlanning, WhatRunsGoesOnUnderTheNextVersion) {
  engine.image("1", CommitState::committed);
  engine.image("2", CommitState::planned, 100);
  send_at(10, [this] {
    engine.remove("2");
    engine.image("3", CommitState::committed, 50);
  });
  run(1000, with_plan(robot_and({photo("1"), photo("3")})));
  EXPECT_THAT(begun(), ElementsAre("1", "3"));
  EXPECT_THAT(trace, Not(Contains("cancel")));
  EXPECT_EQ(reactor.plan_version(), 2U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ContinuousPlanning, AVersionThatTouchesACommitmentIsRefusedAndThePlanGoesOn) {
  engine.image("1", CommitState::committed, 20);
  send_at(10, [this] { engine.remove("1"); });
  run(1000, with_plan(robot_and({photo("1")})));
  EXPECT_THAT(trace, Contains("plan.refused"));
  EXPECT_EQ(reactor.plan_version(), 1U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ContinuousPlanning, ADeltaOfAnotherVersionIsRefusedAndTheWholePlanTaken) {
  engine.image("1", CommitState::committed, 50);
  run(10, with_plan(robot_and({photo("1"), photo("2")})));
  engine.image("2", CommitState::committed, 100);
  engine.delta();  // lost on its way
  engine.find("2").utility = {1};
  ReactorInputs next;
  next.deltas.push_back(engine.delta());
  run(20, std::move(next));
  EXPECT_THAT(reactor.receipt(), AllOf(Field(&PlanReceipt::version, 1U), Field(&PlanReceipt::refused, 3U),
                                       Field(&PlanReceipt::reason, HasSubstr("changes version 2"))));
  next = {};
  next.deltas.push_back(engine.delta(true));
  run(1000, std::move(next));
  EXPECT_THAT(begun(), ElementsAre("1", "2"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ContinuousPlanning, AVersionThatCommitsWhatIsTooLateIsRefused) {
  engine.image("1", CommitState::planned, 0, 50);
  engine.image("2", CommitState::committed, 300);
  send_at(100, [this] { engine.find("1").commit = CommitState::committed; });
  run(200, with_plan(robot_and({photo("1"), photo("2")})));
  EXPECT_THAT(reactor.receipt().reason, HasSubstr("1 would have to start before"));
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  run(1000, {});
  EXPECT_THAT(begun(), ElementsAre("2"));
}

TEST_F(ContinuousPlanning, ABrokenPlanIsMendedByTheNextVersion) {
  camera_works = false;
  engine.image("1", CommitState::committed);
  std::string refused;
  at(50, [this] {  // the engine has not heard yet
    const temporal::FlexiblePlan before = engine.told();
    engine.image("2", CommitState::planned);
    pending.deltas.push_back(engine.delta());
    engine.take_back(before);
  });
  at(55, [&] { refused = reactor.receipt().reason; });
  send_at(60, [this] {
    camera_works = true;
    engine.remove("2");
    engine.remove("1");
    engine.image("1b", CommitState::committed, 400);  // later than it would have waited for a mend
    engine.find("1b").arguments = {{"image", "image-1"}};
    engine.find("1b").goals_served = {"ground/1"};
  });
  run(1000, with_plan(robot_and({photo("1")})));
  EXPECT_THAT(refused, HasSubstr("1 has ended without success"));
  EXPECT_THAT(begun(), ElementsAre("1", "1b"));
  EXPECT_THAT(trace, IsSupersetOf({"plan.broken", "plan.adopted", "goal.achieved"}));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ContinuousPlanning, ABrokenPlanThatNobodyMendsMakesTheRobotSafe) {
  camera_works = false;
  engine.image("1", CommitState::committed);
  run(1000, with_plan(robot_and({photo("1")})));
  EXPECT_THAT(trace, Contains("robot.safe"));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  camera_works = true;
  engine = Engine();
  engine.plan.version = 7;
  engine.image("again", CommitState::committed, 1000);
  engine.find("again").arguments = {{"image", "image-1"}};
  run(2000, with_plan({}));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ContinuousPlanning, NoPlanIsTakenBeforeTheRobotHasBeenSeen) {
  engine.image("1", CommitState::committed);
  ReactorInputs first;
  first.goals = {photo("1")};
  run(10, with_plan(std::move(first)));
  EXPECT_FALSE(reactor.receipt().open);
  EXPECT_THAT(begun(), ElementsAre());
  ReactorInputs seen;
  seen.observations = standing_robot();
  run(20, std::move(seen));
  EXPECT_TRUE(reactor.receipt().open);
}

TEST_F(ContinuousPlanning, APlanOfAnotherEngineOrAnOldVersionIsRefused) {
  engine.plan.engine = "somebody";
  engine.image("1", CommitState::committed);
  run(10, with_plan(robot_and({photo("1")})));
  EXPECT_THAT(reactor.receipt().reason, HasSubstr("engine 'somebody'"));
  engine.plan.engine = "scripted";
  engine.plan.version = 0;
  ReactorInputs whole;
  whole.deltas = {engine.delta(true), engine.delta(true)};
  whole.deltas[1].added.version = 1;
  run(20, std::move(whole));
  EXPECT_THAT(reactor.receipt().reason, HasSubstr("version 1 was known"));
  EXPECT_EQ(reactor.plan_version(), 1U);
}

TEST_F(ContinuousPlanning, AtRestASnapshotIsAllThereIsToKnow) {
  engine.image("1", CommitState::committed);
  run(1000, with_plan(robot_and({photo("1"), photo("2")})));
  ASSERT_TRUE(reactor.at_rest());
  const std::string snapshot = reactor.snapshot();
  reactor = Reactor(mission);
  reactor.restore(snapshot);
  EXPECT_EQ(reactor.receipt().version, 0U);
  engine.image("2", CommitState::committed);
  ReactorInputs whole;
  whole.deltas = {engine.delta(true)};
  run(1010, std::move(whole));
  EXPECT_THAT(reactor.receipt().reason, HasSubstr("1 has ended"));
  engine.remove("1");
  whole.deltas = {engine.delta(true)};
  run(2000, std::move(whole));
  EXPECT_THAT(begun(), ElementsAre("1", "2"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// R81: conflicts are looked for from the end of the commit window to the end of the plan.
class ConflictsAhead : public ContinuousPlanning {
 protected:
  ConflictsAhead() {
    engine.image("1", CommitState::committed);
    engine.image("2", CommitState::planned, 400);
  }
  void needs_battery(const std::string& id) {
    engine.find(id).pre = temporal::compare("rover.battery", temporal::ConditionOp::ge, 500000.0);
    engine.find(id).impacts = {
        {"rover.battery", temporal::ImpactKind::delta, temporal::ImpactWhen::at_end, -1.0}};
  }
  void needs_lamp(const std::string& id) {
    engine.find(id).pre = temporal::compare("lamp", temporal::ConditionOp::eq, true);
  }
  void see_at(double time_s, const std::string& timeline, const temporal::Value& value) {
    at(time_s, [this, timeline, value] { pending.observations.push_back({timeline, value}); });
  }
};

// R99: the second attempt takes all of it once more.
TEST_F(ConflictsAhead, WhatARetryTakesAgainIsMissed) {
  engine.find("1").retries = 1;
  engine.find("1").impacts = {
      {"rover.battery", temporal::ImpactKind::delta, temporal::ImpactWhen::at_end, -200000.0}};
  needs_battery("2");
  see_at(1, "rover.battery", 600000.0);
  at(10, [this] { pending.acks.push_back({"1", 1, executive::CommandStage::failed, "dark", "too dark"}); });
  run(9, with_plan(robot_and({photo("1"), photo("2")})));
  EXPECT_EQ(reactor.receipt().conflict, "");
  run(11, {});
  EXPECT_THAT(reactor.receipt().conflict, HasSubstr("2 will lack rover.battery >= 500000 (is 400000)"));
}

TEST_F(ConflictsAhead, AreToldToTheEngineAndWhatIsCommittedGoesOn) {
  needs_battery("2");
  see_at(10, "rover.battery", 400000.0);
  run(20, with_plan(robot_and({photo("1"), photo("2")})));
  EXPECT_THAT(reactor.receipt(), AllOf(Field(&PlanReceipt::version, 1U), Field(&PlanReceipt::refused, 0U),
                                       Field(&PlanReceipt::conflict,
                                             HasSubstr("2 will lack rover.battery >= 500000 (is 400000)"))));
  EXPECT_EQ(std::ranges::count(trace, "plan.conflict"), 1);
  see_at(30, "rover.battery", 390000.0);
  see_at(40, "rover.battery", 900000.0);
  run(35, {});
  EXPECT_THAT(reactor.receipt().conflict, HasSubstr("(is 400000)")) << "the same conflict is told once";
  run(100, {});
  EXPECT_EQ(reactor.receipt().conflict, "");
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  EXPECT_THAT(begun(), ElementsAre("1"));
}

TEST_F(ConflictsAhead, OfWhatIsCommittedBreakThePlanUntilAVersionRepairsIt) {
  engine.find("2").commit = CommitState::committed;
  needs_lamp("2");
  ReactorInputs first = robot_and({photo("1"), photo("2")});
  first.observations.push_back({"lamp", true});
  see_at(100, "lamp", false);
  send_at(150, [this] {
    engine.image("light", CommitState::committed, 160);
    engine.find("light").impacts = {
        {"lamp", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, true}};
  });
  see_at(200, "lamp", true);
  run(140, with_plan(std::move(first)));
  EXPECT_THAT(trace, Contains("plan.broken"));
  EXPECT_THAT(reactor.receipt().conflict, HasSubstr("2, due at"));
  EXPECT_EQ(reactor.phase(), MissionPhase::executing);
  run(1000, {});
  EXPECT_THAT(begun(), ElementsAre("1", "light", "2"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ConflictsAhead, OfWhatIsCommittedThatNobodyRepairsMakeTheRobotSafe) {
  engine.find("2").commit = CommitState::committed;
  needs_battery("2");
  see_at(50, "rover.battery", 400000.0);
  run(390, with_plan(robot_and({photo("1"), photo("2")})));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_THAT(begun(), ElementsAre("1"));
}

// A state conflict must last; versions that come faster than that do not hide it.
TEST_F(ConflictsAhead, AreSeenThroughOneVersionAfterTheOther) {
  needs_lamp("2");
  ReactorInputs first = robot_and({photo("1"), photo("2")});
  first.observations.push_back({"lamp", false});
  for (int second = 1; second < 20; ++second) send_at(second, [this] { engine.find("2").utility += {1}; });
  run(19.5, with_plan(std::move(first)));
  EXPECT_EQ(reactor.plan_version(), 20U);
  EXPECT_THAT(reactor.receipt().conflict, HasSubstr("lamp = true (is false)"));
}

// Activities come in the order in which the engine thinks of them.
TEST_F(ConflictsAhead, AreReckonedInTheOrderOfStarts) {
  needs_battery("2");
  engine.find("2").impacts[0].amount = -500000.0;
  send_at(10, [this] {
    engine.image("3", CommitState::planned, 200, 300);
    needs_battery("3");
  });
  run(20, with_plan(robot_and({photo("1"), photo("2"), photo("3")})));
  EXPECT_EQ(reactor.plan_version(), 2U);
  EXPECT_EQ(reactor.receipt().conflict, "") << "3 starts before 2 takes the rest";
}

// An engine that changes its mind about everything but what it has promised, and sometimes about that.
class RandomEngine : public ContinuousPlanning, public ::testing::WithParamInterface<int> {};

TEST_P(RandomEngine, WhatItCommitsIsDoneOnceAndNothingElse) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  std::set<std::string> promised;
  std::vector<GoalRequest> goals;
  for (int i = 0; i < 12; ++i) goals.push_back(photo(std::to_string(i)));
  int next = 0;
  engine.image(std::to_string(next++), CommitState::planned);
  run(1, with_plan(robot_and(goals)));
  for (double time = 5; time < 900; time += 30) {
    if (next < 12 && random() % 2 == 0) engine.image(std::to_string(next++), CommitState::planned, time);
    if (!engine.plan.activities.empty()) {
      const PlanActivity chosen = engine.plan.activities[random() % engine.plan.activities.size()];
      const bool bound = promised.contains(chosen.id);
      switch (random() % 3) {
        case 0:
          if (!bound && next > 3) engine.remove(chosen.id);
          break;
        case 1:
          engine.find(chosen.id).commit = CommitState::committed;
          break;
        default:
          if (!bound) engine.find(chosen.id).utility += {1};
      }
    }
    const temporal::FlexiblePlan before = engine.told();
    const bool whole = reactor.receipt().version == 0;
    if (whole)
      for (const std::string& id : begun()) engine.forget(id);
    ReactorInputs inputs;
    const bool broken_promise = random() % 8 == 0 && !promised.empty();
    const Engine kept = engine;
    if (broken_promise)
      for (const std::string& id : promised)
        if (std::ranges::find(engine.plan.activities, id, &PlanActivity::id) != engine.plan.activities.end())
          engine.find(id).duration_lower = seconds(39);
    inputs.deltas.push_back(engine.delta(whole));
    run(time + 30, std::move(inputs));
    if (reactor.plan_version() == engine.plan.version || reactor.receipt().refused != engine.plan.version) {
      for (const PlanActivity& activity : engine.plan.activities)
        if (activity.commit == CommitState::committed) promised.insert(activity.id);
    } else {
      const std::uint32_t version = engine.plan.version;
      engine = kept;
      engine.plan.version = version;
      engine.take_back(before);
    }
  }
  run(3000, {});
  const std::vector<std::string> done = begun();
  EXPECT_EQ(std::set<std::string>(done.begin(), done.end()), promised);
  EXPECT_EQ(done.size(), promised.size());
  EXPECT_THAT(trace, Not(Contains("cancel")));
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  for (const std::string& id : promised) EXPECT_EQ(reasons[id], "observed") << id;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEngine, ::testing::Range(0, 60));

}  // namespace
}  // namespace roci::exec::testing
