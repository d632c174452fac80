// What goes wrong around the reactor: components that do not stop, owners that die, commands that keep
// failing, energy that is gone, goals that change during a planner call.
#include <set>

#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandStage;
using goals::GoalClass;
using goals::GoalRequest;
using goals::GoalState;
using mission::Component;
using mission::StateModel;
using mission::TimelineFamily;
using reactor::MissionPhase;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::ReactorInputs;
using temporal::Verdict;

namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct Active {
  const char* component;
  temporal::State seen;
  temporal::State rest;
};
void PrintTo(const Active& active, std::ostream* out) { *out << active.component << " " << active.seen.name; }

class FallbackTest : public ReactorTest, public ::testing::WithParamInterface<Active> {};

// R43, R44: planning begins only from inactive states, and the way there is each component's own command.
TEST_P(FallbackTest, BeforePlanningAnActiveComponentFallsBack) {
  const std::string timeline = std::string("rover.") + GetParam().component;
  for (Component& component : mission.components) component.fallback = "rest-" + component.name;
  ReactorInputs inputs = robot_and({photo("a")});
  inputs.observations.push_back({timeline, GetParam().seen});
  run(10, std::move(inputs));
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].owner, "sim_svc");
  EXPECT_EQ(commands[0].subsystem, GetParam().component);
  EXPECT_EQ(commands[0].command_name, std::string("rest-") + GetParam().component);
  EXPECT_THAT(trace, Not(Contains("call")));
  ReactorInputs stopped;
  stopped.observations = {{timeline, GetParam().rest}};
  run(500, std::move(stopped));
  EXPECT_THAT(trace, Contains("call"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// R44: what was achieved stays so while components fall back; the next plan begins with it.
TEST_F(ReactorTest, StatesOfScienceGoalsPersistWhileComponentsFallBack) {
  std::string problem;
  planner = [&](const PlanRequest& call) {
    problem = call.problem.text;
    return image_every_goal(call);
  };
  ReactorInputs inputs = robot_and({photo("a"), photo("b")});
  inputs.observations.push_back({"rover.image.image-b", state("stored")});
  inputs.observations.push_back({"rover.camera", state("imaging")});
  run(10, std::move(inputs));
  EXPECT_THAT(trace, AllOf(Contains("stop"), Not(Contains("call"))));
  ReactorInputs stopped;
  stopped.observations = {{"rover.camera", state("idle")}};
  run(12, std::move(stopped));
  EXPECT_THAT(problem, AllOf(HasSubstr("(have-image image-b)"), Not(HasSubstr("(have-image image-a)"))));
}

// R45: these are all the active states there are.
TEST_F(ReactorTest, EveryComponentHasTheStatesOfThePaper) {
  std::vector<std::string> active;
  for (const Component& component : mission.components) {
    for (const StateModel& one : component.states)
      if (one.active) active.push_back(component.name + " " + one.name);
  }
  EXPECT_THAT(active, ElementsAre("nav going-to", "arm going-to", "camera imaging", "radio sending",
                                  "gripper working"));
  for (const TimelineFamily& family : mission.families)
    for (const StateModel& one : family.states) EXPECT_FALSE(one.active) << family.prefix << one.name;
}

INSTANTIATE_TEST_SUITE_P(
    States, FallbackTest,
    ::testing::Values(Active{"nav", {"going-to", {"place-a"}}, {"idle-at", {"here"}}},
                      Active{"arm", {"going-to", {"sampling"}}, {"idle-pose", {"arm-here"}}},
                      Active{"camera", {"imaging", {}}, {"idle", {}}},
                      Active{"radio", {"sending", {}}, {"idle", {}}},
                      Active{"gripper", {"working", {}}, {"empty", {}}},
                      Active{"nav", {"tumbling", {}}, {"idle-at", {"here"}}}),
    [](const auto& test) {
      return test.param.component + std::string("_") + test.param.seen.name.substr(0, 4);
    });

// The robot dies while it is paused: nothing answers the cancel, nothing confirms the fallback.
TEST_F(ReactorTest, AnOwnerLostDuringThePauseMakesTheRobotSafeAndItsReturnResumes) {
  run(20, robot_and({photo("a")}));
  ASSERT_EQ(reactor.phase(), MissionPhase::executing);
  robot_is_dead = true;
  robot_events.clear();
  ReactorInputs lost;
  lost.goals = {photo("b", GoalClass::opportunistic)};
  lost.losses = {{"sim_svc", "killed"}};
  run(70, std::move(lost));
  EXPECT_EQ(reactor.phase(), MissionPhase::pausing);
  run(200, {});
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_EQ(reactor.outcome(), "failed") << "nobody knows that the camera has stopped";
  EXPECT_THAT(reasons["a"], HasSubstr("camera did not become inactive in time"));
  EXPECT_THAT(trace, Not(Contains("goal.dropped")));
  EXPECT_EQ(reactor.goals().open().size(), 2U);

  robot_is_dead = false;
  ReactorInputs back;
  back.arrivals = {"sim_svc"};
  back.observations = {{"rover.camera", state("idle")}};
  run(1000, std::move(back));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

// A network falls apart and heals: the planner is heard before the robot is, and proves with the picture of before that
// the goal is out of reach.
TEST_F(ReactorTest, NoGoalEndsWhileAServiceThatObservesIsAway) {
  bool away = true;
  planner = [&](const PlanRequest& call) {
    return away ? reply(Verdict::unsolvable, "never reached") : image_every_goal(call);
  };
  run(10, robot_and({}));
  ReactorInputs lost;
  lost.losses = {{"sim_svc", "cut off", true}};
  lost.goals = {photo("a"), photo("b", GoalClass::opportunistic)};
  run(30, std::move(lost));
  EXPECT_THAT(trace, Contains("plan.retry"));
  EXPECT_THAT(trace, Not(Contains(::testing::AnyOf("goal.failed", "goal.dropped"))));
  away = false;
  ReactorInputs back;
  back.arrivals = {"sim_svc"};
  run(1000, std::move(back));
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

// Its calls run out as those of a planner that fails; a proof of a call that was made with
// everybody there counts at once.
TEST_F(ReactorTest, AProofIsBelievedInTheEndAndAtOnceOnceEverybodyIsBack) {
  planner = [](const PlanRequest&) { return reply(Verdict::unsolvable, "never reached"); };
  run(10, robot_and({}));
  ReactorInputs lost;
  lost.losses = {{"sim_svc", "cut off", true}};
  lost.goals = {photo("a")};
  run(2000, std::move(lost));
  EXPECT_EQ(std::ranges::count(trace, "plan.retry"), mission.executive.call_retries);
  EXPECT_EQ(std::ranges::count(trace, "goal.failed"), 1);
  trace.clear();
  ReactorInputs back;
  back.arrivals = {"sim_svc"};
  back.goals = {photo("b")};
  run(3000, std::move(back));
  EXPECT_THAT(trace, Not(Contains("plan.retry")));
  EXPECT_EQ(std::ranges::count(trace, "goal.failed"), 1);
}

// Nor is one that observes nothing missed.
TEST_F(ReactorTest, AServiceThatObservesNothingMakesNoProofDoubtful) {
  planner = [](const PlanRequest&) { return reply(Verdict::unsolvable, "never reached"); };
  run(10, robot_and({}));
  ReactorInputs lost;
  lost.losses = {{"science_svc", "killed", false}};
  lost.goals = {photo("a")};
  run(20, std::move(lost));
  EXPECT_THAT(trace, Not(Contains("plan.retry")));
  EXPECT_EQ(std::ranges::count(trace, "goal.failed"), 1);
}

// Of a robot that is not there nothing is ever observed.
TEST_F(ReactorTest, AWishForAPlanTellsOnceForWhomItWaits) {
  ReactorInputs wish;
  wish.goals = {photo("a")};
  run(20, std::move(wish));
  EXPECT_EQ(std::ranges::count(trace, "plan.waits"), 1);
  EXPECT_THAT(trace, Not(Contains("plan.wanted")));
  run(200, robot_and({}));
  EXPECT_EQ(std::ranges::count(trace, "plan.waits"), 1);
  EXPECT_THAT(trace, Contains("plan.wanted"));
}

TEST_F(ReactorTest, AnOwnerThatComesBackWithinThePauseHearsTheFallbackAgain) {
  run(20, robot_and({photo("a")}));
  robot_is_dead = true;
  robot_events.clear();
  ReactorInputs more;
  more.goals = {photo("b")};
  run(60, std::move(more));
  const auto stops = [this] {
    return std::count_if(commands.begin(), commands.end(),
                         [](const Command& command) { return command.command_name == "stop"; });
  };
  EXPECT_EQ(stops(), 1);
  ReactorInputs back;
  back.arrivals = {"sim_svc"};
  run(61, std::move(back));
  EXPECT_EQ(stops(), 2);
  EXPECT_EQ(reactor.phase(), MissionPhase::pausing);
}

// Behind a link a fallback may be lost: it is sent again under its key, once in the time of an answer.
TEST_F(ReactorTest, AFallbackOverALinkIsRepeatedUntilTheComponentIsInactive) {
  mission.executive.round_trips["sim_svc"] = seconds(10);
  reactor = reactor::Reactor(mission);
  run(20, robot_and({photo("a")}));
  robot_is_dead = true;
  robot_events.clear();
  ReactorInputs more;
  more.goals = {photo("b")};
  more.acks = {{"aa", 1, executive::CommandStage::failed, "", "shutter"}};
  run(200, std::move(more));
  std::set<std::string> keys;
  int stops = 0;
  for (const Command& command : commands) {
    if (command.command_name != "stop") continue;
    ++stops;
    keys.insert(command.activity);
  }
  EXPECT_GE(stops, 3);
  EXPECT_EQ(keys.size(), 1U);
  EXPECT_EQ(reactor.phase(), MissionPhase::safe) << "nobody answered within the time for fallbacks";
}

// As the mission says: a longest pause of 120 s, and eight failures in a row.
TEST_F(ReactorTest, AComponentThatKeepsFailingGetsTimeThenItsGoalsGoAlone) {
  camera_works = false;
  std::vector<double> calls;
  planner = [&](const PlanRequest& call) {
    calls.push_back(temporal::to_seconds(now));
    return image_every_goal(call);
  };
  run(3000, robot_and({photo("hard"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_THAT(reasons["hard"], HasSubstr("camera failed 8 times in a row, last as p8.1-take-image "));
  EXPECT_THAT(reasons["hard"], HasSubstr("shutter"));
  EXPECT_THAT(reasons["soft"], HasSubstr("camera failed 8 times in a row, last as p16.1-take-image "));
  EXPECT_EQ(reactor.goals().find({"ground", "hard"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "soft"})->state, GoalState::dropped);
  EXPECT_EQ(reactor.outcome(), "partial");
  ASSERT_EQ(calls.size(), 16U);
  const double origin_and_image = 45;  // from a call to the end of the failing image
  EXPECT_EQ(calls[1] - calls[0], origin_and_image);
  EXPECT_EQ(calls[2] - calls[1], origin_and_image + 30);
  EXPECT_EQ(calls[3] - calls[2], origin_and_image + 60);
  EXPECT_EQ(calls[4] - calls[3], origin_and_image + 120);
  for (const std::size_t i : {4U, 5U, 6U}) EXPECT_EQ(calls[i + 1] - calls[i], origin_and_image + 120);
  EXPECT_EQ(calls[8] - calls[7], origin_and_image);
}

// An engine may plan for the other goals without it; what it does then makes it trusted again.
TEST_F(ReactorTest, AComponentWhoseGoalsWereGivenUpIsNotTrustedUntilItSucceeds) {
  camera_works = false;
  std::vector<bool> trusted;
  planner = [&](const PlanRequest& call) {
    trusted.push_back(!reactor.concluded().contains("trust.camera"));
    return image_every_goal(call);
  };
  run(1200, robot_and({photo("first"), photo("second", GoalClass::optional, 1)}));
  ASSERT_EQ(reactor.goals().find({"ground", "first"})->state, GoalState::failed);
  EXPECT_THAT(std::vector(trusted.begin(), trusted.begin() + 8), ::testing::Each(true));
  EXPECT_FALSE(trusted.back());
  EXPECT_EQ(temporal::to_text(reactor.concluded().at("trust.camera")), "lost");
  camera_works = true;
  run(2000, {});
  EXPECT_EQ(reactor.goals().find({"ground", "second"})->state, GoalState::achieved);
  EXPECT_FALSE(reactor.concluded().contains("trust.camera"));
}

TEST_F(ReactorTest, ACommandThatItsOwnerDoesNotKnowCostsItsGoalAtOnceAndNoOther) {
  const Planner all = planner;
  planner = [&, all](const PlanRequest& call) {
    PlanReply out = all(call);
    if (out.plan.activities.front().arguments.front().value == "image-a") {
      other_events.emplace(now + seconds(6), [this] {
        pending.acks.push_back({"p1.1-take-image", 1, CommandStage::rejected, "unknown-command", "no such"});
      });
    }
    return out;
  };
  run(30, robot_and({photo("a"), photo("b")}));
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::failed);
  EXPECT_THAT(reasons["a"], HasSubstr("p1.1-take-image will never be taken: rejected"));
  run(1000, {});
  EXPECT_EQ(reactor.goals().find({"ground", "b"})->state, GoalState::achieved);
}

TEST_F(ReactorTest, AComponentThatRecoversInTimeLosesNoGoal) {
  camera_works = false;
  run(150, robot_and({photo("a")}));
  camera_works = true;
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().replans, 2U);
}

TEST_F(ReactorTest, ASuccessBetweenFailuresStartsTheCountAnew) {
  camera_works = false;
  run(150, robot_and({photo("a")}));  // two failures
  camera_works = true;
  run(400, {});
  camera_works = false;
  ReactorInputs more;
  more.goals = {photo("b")};
  run(640, std::move(more));  // three more
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.broken"), 5);
  camera_works = true;
  run(2000, {});
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

TEST_F(ReactorTest, GoalsThatArriveDuringAPauseAreInThePlanThatFollows) {
  run(20, robot_and({photo("a")}));
  robot_is_dead = true;
  robot_events.clear();
  trace.clear();
  for (const char* id : {"b", "c"}) {
    ReactorInputs more;
    more.goals = {photo(id)};
    run(id[0] == 'b' ? 30 : 40, std::move(more));
  }
  robot_is_dead = false;
  ReactorInputs stopped;
  stopped.observations = {{"rover.camera", state("idle")}};
  run(1000, std::move(stopped));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 1);
  EXPECT_EQ(reactor.counts().achieved, 3U);
}

TEST_F(ReactorTest, EnergyThatIsGoneBreaksThePlanAtOnce) {
  planner = [this](const PlanRequest& call) {
    PlanReply out = image_every_goal(call);
    for (temporal::PlanActivity& activity : out.plan.activities) {
      activity.pre = temporal::compare("(battery)", temporal::ConditionOp::ge, 300000.0);
      activity.impacts = {
          {"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -200000.0}};
    }
    const bool fits =
        std::get<double>(battery) >= 100000.0 + 200000.0 * static_cast<double>(out.plan.activities.size());
    return fits ? out : reply(Verdict::unsolvable, "too little energy");
  };
  run(20, robot_and({photo("a"), photo("b", GoalClass::optional, 1), photo("c", GoalClass::optional, 2)}));
  ASSERT_EQ(reactor.phase(), MissionPhase::executing);
  trace.clear();
  battery = 450000.0;
  ReactorInputs loss;
  loss.observations = {{"rover.battery", battery}};
  run(21, std::move(loss));
  EXPECT_THAT(trace, ElementsAre("plan.broken", "plan.wanted", "cancel", "call", "goal.dropped", "call",
                                 "goal.dropped", "call", "plan.adopted"));
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::planned);
}

TEST_F(ReactorTest, AGoalThatArrivesDuringAPlannerCallGetsAPlanOfItsOwnAfterwards) {
  planning_time = seconds(30);
  run(10, robot_and({photo("a")}));
  ASSERT_EQ(reactor.phase(), MissionPhase::planning);
  ReactorInputs more;
  more.goals = {photo("b")};
  run(20, std::move(more));
  more.goals = {photo("c")};
  run(1000, std::move(more));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 3);
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.adopted"), 1);
  EXPECT_EQ(reactor.counts().achieved, 3U);
}

// A planner that hangs, or whose answer is on its way already.
TEST_F(ReactorTest, OfACancelledCallOneEndIsAwaitedWhateverItIs) {
  planning_time = seconds(30);
  planner_hears_cancels = false;
  run(10, robot_and({photo("a")}));
  for (const char* id : {"b", "c"}) {
    ReactorInputs more;
    more.goals = {photo(id)};
    run(id[0] == 'b' ? 15 : 20, std::move(more));
  }
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "cancel call"), 1) << "asked once";
  run(1000, {});
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 2);
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.adopted"), 1);
  EXPECT_EQ(reactor.counts().achieved, 3U);
}

TEST_F(ReactorTest, AGoalThatArrivesEndsTheStaleCallAndOneMoreFollowsAtOnce) {
  planning_time = seconds(30);
  run(10, robot_and({photo("a")}));
  trace.clear();
  ReactorInputs more;
  more.goals = {photo("b")};
  run(11, std::move(more));
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "plan.outdated", "cancel call", "plan.wanted", "call"));
  run(41, {});
  EXPECT_EQ(reactor.phase(), MissionPhase::executing)
      << "30 s after the goal came, not 30 s after the stale call's end";
}

TEST_F(ReactorTest, ACallThatNobodyNeedsAnyMoreIsCancelled) {
  planning_time = seconds(30);
  run(10, robot_and({photo("a")}));
  trace.clear();
  ReactorInputs seen;
  seen.observations = {{"rover.image.image-a", state("sent")}};
  run(11, std::move(seen));
  EXPECT_THAT(trace, ElementsAre("goal.achieved", "plan.outdated", "cancel call"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// The verdict on a problem with the recalled goal says nothing about the one without it.
TEST_F(ReactorTest, AGoalRecalledDuringAPlannerCallTakesNoOtherWithIt) {
  planning_time = seconds(30);
  planner = [this](const PlanRequest& call) {
    return call.problem.text.find("image-walled") != std::string::npos
               ? reply(Verdict::unsolvable, "goals do not fit")
               : image_every_goal(call);
  };
  run(10, robot_and({photo("walled"), photo("soft", GoalClass::opportunistic)}));
  ReactorInputs recall;
  recall.goals = {photo("walled")};
  recall.goals[0].recalled = true;
  run(1000, std::move(recall));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::recalled);
  EXPECT_EQ(reactor.goals().find({"ground", "soft"})->state, GoalState::achieved);
  EXPECT_THAT(trace, Not(Contains("goal.dropped")));
}

TEST_F(ReactorTest, TheLastGoalRecalledDuringAPlannerCallEndsTheMission) {
  planning_time = seconds(30);
  run(10, robot_and({photo("a")}));
  ReactorInputs recall;
  recall.goals = {photo("a")};
  recall.goals[0].recalled = true;
  run(1000, std::move(recall));
  EXPECT_EQ(reactor.phase(), MissionPhase::finished);
  EXPECT_TRUE(commands.empty());
}

TEST_F(ReactorTest, TheGoalBeingExecutedIsRecalledAndTheRestGoesOn) {
  run(20, robot_and({photo("a"), photo("b")}));
  ReactorInputs recall;
  recall.goals = {photo("a")};
  recall.goals[0].recalled = true;
  trace.clear();
  run(1000, std::move(recall));
  EXPECT_THAT(trace, ElementsAre("goal.recalled", "plan.wanted", "cancel", "call", "plan.adopted", "image",
                                 "goal.achieved", "plan.finished"));
  EXPECT_EQ(reactor.goals().find({"ground", "b"})->state, GoalState::achieved);
}

TEST_F(ReactorTest, AWindowInThePastAndAnIdInUseAreRejectedAndChangeNothing) {
  run(20, robot_and({photo("a")}));
  GoalRequest past = photo("past");
  past.closes = seconds(15);
  GoalRequest twin = photo("a");
  twin.key.issuer = "science_svc";
  ReactorInputs inputs;
  inputs.goals = {past, twin, photo("a")};
  trace.clear();
  run(1000, std::move(inputs));
  EXPECT_THAT(trace, ElementsAre("goal.rejected", "goal.rejected", "goal.achieved", "plan.finished"));
  EXPECT_THAT(reasons["past"], HasSubstr("has passed"));
}

TEST_F(ReactorTest, AmongNamedGoalsASoftOneGoesFirst) {
  planner = [this](const PlanRequest& call) {
    return reactor.goals().open().size() > 2 ? blocked({"hard", "one", "two"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("other", GoalClass::opportunistic),
                       photo("one", GoalClass::opportunistic), photo("two", GoalClass::opportunistic)}));
  EXPECT_EQ(reactor.goals().find({"ground", "two"})->state, GoalState::dropped);
  EXPECT_EQ(reactor.goals().find({"ground", "one"})->state, GoalState::dropped);
  EXPECT_EQ(reactor.goals().find({"ground", "hard"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "other"})->state, GoalState::achieved);
}

// The planner does not take one goal, and says of no goal which.
TEST_F(ReactorTest, TheGoalThatMakesTheProblemInvalidIsFoundAndTheOthersGoOn) {
  std::vector<std::string> asked;
  planner = [&](const PlanRequest& call) {
    std::string goals;
    std::vector<std::string> ids;
    for (const problem::ProblemGoal& goal : call.problem.goals) ids.push_back(goal.key.id);
    for (const std::string& id : ids) goals += id;
    asked.push_back(goals);
    if (asks_for(call, "b")) return reply(Verdict::invalid_input, "expected a ')'");
    PlanReply out = reply(Verdict::solved);
    out.plan = images(ids);
    return out;
  };
  run(1000, robot_and({photo("a"), photo("b"), photo("c")}));
  EXPECT_THAT(asked, ElementsAre("abc", "ab", "ac", "ac"));
  EXPECT_THAT(reasons["b"], HasSubstr("the planner calls every problem with it invalid: expected a ')'"));
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "b"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "c"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "partial");
}

// It is not the goals: they wait for the ground.
TEST_F(ReactorTest, AProblemThatIsInvalidWithoutAnyGoalMakesTheRobotSafeAndLosesNone) {
  planner = [&](const PlanRequest&) { return reply(Verdict::invalid_input, "what is this"); };
  run(1000, robot_and({photo("a"), photo("b")}));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_EQ(reactor.counts().open, 2U);
  EXPECT_EQ(std::ranges::count(trace, "call"), 3);
}

// An image that was seen before anybody asked for it, and one that nobody ever asks for.
TEST_F(ReactorTest, AnObservationOfAnUnknownObjectIsNamedAndTheMissionGoesOn) {
  ReactorInputs inputs = robot_and({photo("a")});
  inputs.observations.push_back({"rover.image.image-b", state("stored")});
  inputs.observations.push_back({"rover.image.image-of-nobody", state("stored")});
  std::vector<std::string> problems;
  planner = [&](const PlanRequest& call) {
    problems.push_back(call.problem.text);
    return image_every_goal(call);
  };
  run(200, std::move(inputs));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0], Not(HasSubstr("image-b")));
  EXPECT_THAT(problems[0], Not(HasSubstr("image-of-nobody")));
  EXPECT_EQ(std::ranges::count(trace, "fact.left_out"), 2);
  ReactorInputs more;
  more.goals = {photo("b")};
  run(1000, std::move(more));
  EXPECT_THAT(problems.back(), HasSubstr("(have-image image-b)"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, AGoalWithAWordThatTheDomainDoesNotKnowFailsAlone) {
  mission.goal_kinds["photo-of-nothing"] = mission.goal_kinds.at("photo");
  mission.goal_kinds["photo-of-nothing"].goal = {"(sent nobody)"};
  GoalRequest bad = photo("b");
  bad.kind = "photo-of-nothing";
  run(1000, robot_and({photo("a"), bad, photo("c")}));
  EXPECT_THAT(reasons["b"], HasSubstr("nobody"));
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "c"})->state, GoalState::achieved);
}

}  // namespace
}  // namespace roci::exec::testing
