// Maps that change while the planner is asked, and verdicts and plans on old ones.
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using goals::GoalClass;
using goals::GoalState;
using reactor::MissionPhase;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::ReactorInputs;
using temporal::Verdict;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

class MapChangeTest : public ReactorTest {
 protected:
  void SetUp() override {
    planning_time = seconds(30);
    ReactorInputs inputs = robot_and({photo("a"), photo("soft", GoalClass::opportunistic)});
    inputs.models = {{"pathplan_svc", 1}, {"arm_svc", 7}};
    run(1, std::move(inputs));
  }
  void change_map_at(double time_s, std::uint64_t version) {
    other_events.emplace(seconds(time_s), [this, version] {
      pending.models = {{"pathplan_svc", version}};
      newest = version;
    });
  }
  PlanReply plan_on_version(const PlanRequest& call, std::uint64_t version) {
    PlanReply out = image_every_goal(call);
    out.plan.function_values = {{"traverse_time", {"here", "place-a"}, 100, "pathplan_svc", version}};
    return out;
  }
  std::uint64_t newest = 1;
};

TEST_F(MapChangeTest, EachChangeDuringACallEndsItAndTheNextOneFollowsAtOnce) {
  planner = [&](const PlanRequest& call) { return plan_on_version(call, newest); };
  change_map_at(10, 2);
  change_map_at(20, 3);
  run(49, {});
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "goal.accepted", "plan.wanted", "call", "plan.outdated",
                                 "cancel call", "call", "plan.outdated", "cancel call", "call"));
  run(1000, {});
  EXPECT_EQ(reactor.counts().achieved, 2U);
  EXPECT_EQ(reactor.counts().replans, 0U);
}

// A cancel that comes too late: what counts is what the plan stands on.
TEST_F(MapChangeTest, APlanOnTheNewestMapIsTakenEvenIfTheMapChangedDuringTheCall) {
  planner_hears_cancels = false;
  planner = [&](const PlanRequest& call) { return plan_on_version(call, newest); };
  change_map_at(10, 2);
  run(1000, {});
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 1);
}

// What runs goes on; who reads is told which of the rest was planned on an older map.
TEST_F(MapChangeTest, WhatStandsOnAnOlderMapIsToldOnceForEachMap) {
  planner = [&](const PlanRequest& call) {
    PlanReply out = plan_on_version(call, newest);
    const auto& second = out.plan.activities.at(1).arguments;
    std::vector<std::string> objects;
    for (const temporal::Property& argument : second) objects.push_back(argument.value);
    out.plan.function_values = {{"traverse_time", objects, 100, "pathplan_svc", newest},
                                {"arm_move_time", objects, 100, "arm_svc", 7}};
    return out;
  };
  const auto outdated = [&] { return std::count(trace.begin(), trace.end(), "values.outdated"); };
  change_map_at(40, 2);
  change_map_at(41, 2);
  run(41.5, {});
  EXPECT_EQ(reactor.phase(), MissionPhase::executing);
  EXPECT_EQ(outdated(), 1);
  change_map_at(1000, 3);
  run(1100, {});
  EXPECT_EQ(outdated(), 1) << "nothing is left of the plan";
}

TEST_F(MapChangeTest, APlanOnAnOldMapIsNotTaken) {
  planner_hears_cancels = false;
  planner = [&, first = true](const PlanRequest& call) mutable {
    return plan_on_version(call, std::exchange(first, false) ? 1 : newest);
  };
  change_map_at(10, 2);
  change_map_at(20, 3);
  run(1000, {});
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 2);
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.adopted"), 1);
}

TEST_F(MapChangeTest, NoGoalGoesByAVerdictOnAnOldMap) {
  planner_hears_cancels = false;
  planner = [&, first = true](const PlanRequest& call) mutable {
    return std::exchange(first, false) ? reply(Verdict::unsolvable, "no way") : plan_on_version(call, newest);
  };
  change_map_at(10, 2);
  run(1000, {});
  EXPECT_THAT(trace, Not(Contains("goal.dropped")));
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

TEST_F(MapChangeTest, AVerdictOnAMapThatChangedBeforeTheCallCounts) {
  planner = [&](const PlanRequest& call) { return plan_on_version(call, newest); };
  change_map_at(50, 2);
  run(60, {});
  planner = [&](const PlanRequest& call) {
    return reactor.goals().open().size() > 2 ? reply(Verdict::unsolvable, "no way")
                                             : plan_on_version(call, newest);
  };
  ReactorInputs more;
  more.goals = {photo("late", GoalClass::opportunistic)};
  run(1000, std::move(more));
  EXPECT_EQ(reactor.goals().find({"ground", "late"})->state, GoalState::dropped);
  EXPECT_THAT(trace, Not(Contains("plan.outdated")));
}

TEST_F(MapChangeTest, AMapThatNeverRestsDoesNotStopTheMission) {
  for (const bool hears : {true, false}) {
    planner_hears_cancels = hears;
    planner = [&](const PlanRequest& call) { return plan_on_version(call, newest - 1); };
    const double begin = temporal::to_seconds(now);
    for (int i = 1; i < 100; ++i) change_map_at(begin + 20.0 * i, newest + static_cast<std::uint64_t>(i));
    trace.clear();
    ReactorInputs more;
    more.goals = {photo(hears ? "b" : "c")};
    run(begin + 5000, std::move(more));
    EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.outdated"), hears ? 6 : 5) << "one for the goal";
    EXPECT_EQ(reactor.outcome(), "achieved");
  }
}

}  // namespace
}  // namespace roci::exec::testing
