// Conflicts of states seen ahead, against a walk over the plan; and what the reactor makes of them.
#include "exec_svc/reactor/conflict_monitor.hpp"

#include <random>

#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using reactor::ConflictMonitor;
using reactor::MissionPhase;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::ReactorInputs;

namespace {

using temporal::ActivityState;
using temporal::ConditionOp;
using temporal::FlexiblePlan;
using temporal::ImpactKind;
using temporal::ImpactWhen;
using ::testing::Contains;
using ::testing::Not;

temporal::PlanActivity& add(FlexiblePlan& plan, const std::string& id) {
  temporal::PlanActivity& out = plan.activities.emplace_back();
  out.id = id;
  return out;
}

// go: brings (at b); image: needs (at b) and (idle).
FlexiblePlan go_and_image() {
  FlexiblePlan plan;
  add(plan, "go").impacts = {{"(at b)", ImpactKind::assign, ImpactWhen::at_end, true}};
  add(plan, "image").pre = temporal::all_of({temporal::compare("(at b)", ConditionOp::eq, true),
                                             temporal::compare("(idle)", ConditionOp::eq, true)});
  return plan;
}

TEST(ConflictMonitor, NamesWhatNothingBringsAboutOnceItHasLasted) {
  ConflictMonitor monitor(go_and_image(), {}, seconds(5));
  monitor.observe("(at b)", false);
  monitor.observe("(idle)", true);
  EXPECT_FALSE(monitor.conflict(seconds(100))) << "go brings it";
  monitor.change("go", ActivityState::running);
  EXPECT_FALSE(monitor.conflict(seconds(110)));
  monitor.change("go", ActivityState::succeeded);
  EXPECT_FALSE(monitor.conflict(seconds(200))) << "the observation may follow";
  EXPECT_EQ(monitor.next_check(), seconds(205));
  const auto conflict = monitor.conflict(seconds(205));
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->activity, "image");
  EXPECT_EQ(conflict->description, "(at b) = true (is false)");
  monitor.observe("(at b)", true);
  EXPECT_FALSE(monitor.conflict(seconds(206)));
  EXPECT_FALSE(monitor.next_check());
}

TEST(ConflictMonitor, WindowsPushesSkipsAndChoicesRaiseNoAlarm) {
  const auto alarm = [](const FlexiblePlan& plan, const std::set<std::string>& foreseen) {
    ConflictMonitor monitor(plan, foreseen, seconds(0));
    monitor.observe("(idle)", false);
    return monitor.conflict(seconds(1)).has_value();
  };
  EXPECT_TRUE(alarm(go_and_image(), {}));
  EXPECT_FALSE(alarm(go_and_image(), {"(idle)"}));
  FlexiblePlan plan = go_and_image();
  plan.activities[1].may_skip = true;
  EXPECT_FALSE(alarm(plan, {}));
  plan = go_and_image();
  plan.activities[1].skip_if = temporal::compare("(dark)", ConditionOp::eq, true);
  EXPECT_FALSE(alarm(plan, {}));
  plan = go_and_image();
  plan.activities[1].lateness = temporal::LatenessPolicy::push;
  EXPECT_FALSE(alarm(plan, {}));
  plan = go_and_image();
  plan.decisions = {{"way", "arm_svc", {{"left", {"image"}}}, 0}};
  EXPECT_FALSE(alarm(plan, {}));
}

// The first waiting activity, in plan order, with a demand that is unmet and that no other open activity can
// meet.
std::string by_hand(const FlexiblePlan& plan, const std::vector<ActivityState>& states,
                    const std::map<std::string, bool>& values) {
  const auto over = [&](std::size_t i) { return states[i] >= ActivityState::succeeded; };
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    if (states[i] != ActivityState::waiting) continue;
    for (const temporal::ConditionNode& node : plan.activities[i].pre.nodes) {
      if (node.op != ConditionOp::eq || !values.contains(node.timeline)) continue;
      bool met = values.at(node.timeline) == std::get<bool>(node.operand);
      for (std::size_t j = 0; j < plan.activities.size(); ++j)
        for (const temporal::Impact& impact : plan.activities[j].impacts)
          met = met ||
                (j != i && !over(j) && impact.timeline == node.timeline && impact.amount == node.operand);
      if (!met) return plan.activities[i].id;
    }
  }
  return "";
}

TEST(ConflictMonitor, AgreesWithAWalkOverThePlanWhileItIsWorkedOff) {
  std::mt19937_64 random(11);
  const auto fact = [&] { return "(f" + std::to_string(random() % 4) + ")"; };
  int alarms = 0, looks = 0;
  for (int round = 0; round < 500; ++round) {
    FlexiblePlan plan;
    for (std::size_t i = 1 + random() % 6; i > 0; --i) {
      temporal::PlanActivity& activity = add(plan, "a" + std::to_string(plan.activities.size()));
      activity.pre = temporal::all_of({temporal::compare(fact(), ConditionOp::eq, random() % 2 == 0),
                                       temporal::compare(fact(), ConditionOp::eq, random() % 2 == 0)});
      for (std::size_t n = random() % 4; n > 0; --n)
        activity.impacts.push_back({fact(), ImpactKind::assign, ImpactWhen::at_end, random() % 2 == 0});
    }
    ConflictMonitor monitor(plan, {}, seconds(0));
    std::vector<ActivityState> states(plan.activities.size(), ActivityState::waiting);
    std::map<std::string, bool> values;
    for (int update = 0; update < 12; ++update, ++looks) {
      const std::string changed = fact();
      values[changed] = random() % 2 == 0;
      monitor.observe(changed, values[changed]);
      const std::size_t i = random() % states.size();
      states[i] = static_cast<ActivityState>(random() % 7);
      monitor.change(plan.activities[i].id, states[i]);
      const std::string expected = by_hand(plan, states, values);
      const auto got = monitor.conflict(seconds(update));
      EXPECT_EQ(got ? got->activity : "", expected) << round;
      alarms += !expected.empty();
    }
  }
  EXPECT_GT(alarms, looks / 10);
  EXPECT_LT(alarms, looks * 9 / 10);
}

// The second image's place is lost while the first is taken: known at once, not when the second would start.
TEST_F(ReactorTest, AStateThatIsLostBreaksThePlanBeforeTheActivityThatNeedsItIsDue) {
  planner = [this](const PlanRequest& call) {
    PlanReply out = image_every_goal(call);
    for (temporal::PlanActivity& activity : out.plan.activities)
      activity.pre = temporal::compare("(gripper-empty)", ConditionOp::eq, true);
    return out;
  };
  run(20, robot_and({photo("a"), photo("b")}));
  ASSERT_EQ(reactor.phase(), MissionPhase::executing);
  trace.clear();
  ReactorInputs lost;
  lost.observations = {{"rover.gripper", state("holding", {"sample-x"})}};
  run(24, std::move(lost));
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  run(26, {});
  EXPECT_THAT(trace, Contains("plan.broken"));
}

TEST_F(ReactorTest, AStateThatComesBackSoonBreaksNothing) {
  planner = [this](const PlanRequest& call) {
    PlanReply out = image_every_goal(call);
    out.plan.activities.back().pre = temporal::compare("(gripper-empty)", ConditionOp::eq, true);
    return out;
  };
  run(20, robot_and({photo("a"), photo("b")}));
  ReactorInputs lost;
  lost.observations = {{"rover.gripper", state("holding", {"sample-x"})}};
  run(22, std::move(lost));
  ReactorInputs back;
  back.observations = {{"rover.gripper", state("empty")}};
  run(1000, std::move(back));
  EXPECT_THAT(trace, Not(Contains("plan.broken")));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

}  // namespace
}  // namespace roci::exec::testing
