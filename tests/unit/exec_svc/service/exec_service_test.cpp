// The executive as a service: goals over the wire, statuses back, everything in the journal first, and what a
// restart keeps.
#include "exec_svc/exec_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "exec_svc/limits.hpp"
#include "exec_svc/wire_service.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"
#include "tests/unit/exec_svc/service/exec_seat.hpp"

namespace roci::exec {

using goals::GoalRecord;
using goals::GoalState;
using journal::Journal;

namespace {

using namespace std::chrono_literals;
using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(ExecService, ACommandTellsThePlanThatIssuedItsKey) {
  executive::Command command;
  command.plan = 3;
  EXPECT_EQ(to_wire(command, "exec_svc", 50, 1).plan_version(), 3U);
  command.plan = 0;
  EXPECT_EQ(to_wire(command, "exec_svc", 50, 1).plan_version(), 50U);
}

TEST(ExecService, AGoalIsJournalledAcknowledgedPlannedAndAchieved) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  std::vector<std::string> journalled;  // when the first acknowledgement is there
  seat.at(10s + 1us, [&] {
    for (const GoalRecord& record : seat.journal().goals()) journalled.push_back(record.request.key.text());
  });
  seat.run_until(200s);
  EXPECT_THAT(seat.statuses,
              ElementsAre("ridge pending", "ridge planned in plan 1", "ridge achieved observed"));
  EXPECT_THAT(journalled, ElementsAre("ground/ridge"));
  EXPECT_EQ(seat.planner_calls, 1);
  ASSERT_EQ(seat.plans.size(), 1U);
  EXPECT_EQ(seat.plans[0].version(), 1U);
  ASSERT_EQ(seat.commands.size(), 1U);
  EXPECT_EQ(seat.commands[0].command_name(), "image");
  EXPECT_EQ(seat.commands[0].owner(), "sim_svc");
  EXPECT_EQ(seat.commands[0].epoch(), 1U);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.mission.goals_achieved(), 1U);
  EXPECT_EQ(seat.mission.trace_sha256().size(), 64U);
  const auto summary = nlohmann::json::parse(seat.summary());
  EXPECT_EQ(summary["result"], "achieved");
  EXPECT_EQ(summary["trace_sha256"], seat.mission.trace_sha256());
  EXPECT_EQ(seat.journal().goals().at(0).state, GoalState::achieved);
}

TEST(ExecService, TheJournalHasTheRecordOfTheRun) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  seat.run_until(200s);
  std::map<std::string, int> kinds;
  std::vector<std::string> traced;
  seat.journal().for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
    ++kinds[std::string(kind)];
    if (kind == "trace") traced.emplace_back(text);
  });
  EXPECT_EQ(kinds["call"], 1);
  EXPECT_GE(kinds["event"], 4);
  EXPECT_GE(kinds["step"], 3);
  EXPECT_THAT(traced, Contains(HasSubstr(" plan ")));
  EXPECT_THAT(traced, Contains(HasSubstr(" command ")));
  EXPECT_THAT(traced, Contains(HasSubstr(" ack ")));
  EXPECT_THAT(traced, Contains(HasSubstr(" observation ")));
}

TEST(ExecService, ABadGoalIsRefusedAndTheNextOneFlies) {
  ExecSeat seat;
  v1::Goal bad = photo_goal("bad");
  bad.goal_kind("photograph");
  v1::Goal twin = photo_goal("ridge");
  twin.issuer("somebody");
  seat.send(10s, bad);
  seat.send(20s, photo_goal("ridge"));
  seat.send(21s, twin);
  seat.send(22s, photo_goal("ridge"));  // the same again changes nothing and is answered
  seat.run_until(200s);
  EXPECT_THAT(seat.statuses,
              ElementsAre(StartsWith("bad rejected unknown goal kind 'photograph'; this mission knows: "),
                          "ridge pending", "ridge planned in plan 1",
                          "ridge rejected id 'ridge' is in use by issuer 'ground'; choose another id",
                          "ridge planned in plan 1", "ridge achieved observed"));
  EXPECT_EQ(seat.mission.outcome(), "partial") << "a service sent the bad one and reads no answer";
}

TEST(ExecService, ARecalledGoalIsCancelledOnBoard) {
  ExecSeat seat;
  v1::Goal recall = photo_goal("ridge");
  recall.recalled(true);
  seat.send(10s, photo_goal("ridge"));
  seat.send(30s, recall);
  seat.run_until(200s);
  EXPECT_THAT(seat.statuses,
              ElementsAre("ridge pending", "ridge planned in plan 1", "ridge recalled recalled by ground"));
  ASSERT_EQ(seat.commands.size(), 2U);
  EXPECT_EQ(seat.commands[1].action(), v1::COMMAND_CANCEL);
}

// Our own writers refuse it; of what others send, the node tells (Flood in unit_services).
TEST(ExecService, AMalformedObservationIsNotEvenWritten) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  const auto observations = services::advertise(seat.robot(), services::topics::observation);
  seat.at(12s, [&] {
    v1::Observation garbled;
    garbled.timeline("rover.camera");
    garbled.observed().kind(static_cast<v1::ValueKind>(77));
    EXPECT_FALSE(observations.write(garbled));
  });
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
}

// Goals without a fault and known timelines go on whatever fills the tables.
TEST(ExecService, WhatFloodsItsTablesIsRefusedAndTold) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  const auto observations = services::advertise(seat.robot(), services::topics::observation);
  const auto goals = services::advertise(seat.robot(), services::topics::goal);
  const auto orders = services::advertise(seat.robot(), services::topics::order);
  seat.at(12s, [&] {
    for (std::size_t i = 0; i < kTimelines + 10; ++i) {
      v1::Observation observation;
      observation.timeline("x" + std::to_string(i));
      observations.write(observation);
    }
    for (std::size_t i = 0; i < kRejectedGoals + 10; ++i) {
      v1::Goal goal = photo_goal("BAD-" + std::to_string(i));
      goals.write(goal);
    }
  });
  seat.at(13s, [&] {
    for (std::size_t i = 0; i < 10; ++i) goals.write(photo_goal("WORSE-" + std::to_string(i)));
    v1::Order order;
    order.id(std::string(kNameBytes + 1, 'x'));
    orders.write(order);
  });
  services::Node& planner = seat.run().node("planner_svc");
  const auto other_source = services::advertise(planner, services::topics::observation);
  planner.at(14s, [&] {
    v1::Observation observation;
    observation.timeline("x" + std::to_string(kTimelines + 5));
    other_source.write(observation);
  });
  seat.send(20s, photo_goal("second"));
  seat.run_until(300s);
  EXPECT_THAT(seat.events, Contains("timeline.no_room").Times(2)) << "the first and the tenth";
  EXPECT_THAT(seat.events, ::testing::Not(Contains("timeline.contested")))
      << "what is not taken has no source";
  EXPECT_THAT(seat.events, Contains("goal.no_room"));
  EXPECT_THAT(seat.events, Contains("order.no_room").Times(1));
  EXPECT_LE(seat.journal().goals().size(), kRejectedGoals + 2);
  EXPECT_EQ(seat.mission.goals_achieved(), 2U);
}

// The journal leads to where it was: the same plan goes on, nothing is planned or commanded again.
TEST(ExecService, ARestartGoesOnWithTheRunningPlan) {
  ExecSeat seat;
  seat.send(10s, photo_goal("first"));
  seat.send(10s, photo_goal("second"));
  seat.kill_executive_at(80s);  // while the second image is taken
  seat.run_until(500s);
  EXPECT_THAT(seat.events, Contains("executive.resumed"));
  EXPECT_THAT(seat.events, Contains("plan.wanted").Times(1));
  EXPECT_EQ(seat.planner_calls, 1);
  ASSERT_EQ(seat.plans.size(), 2U);
  EXPECT_EQ(seat.plans[1].version(), 1U) << "told again to whoever joins now";
  EXPECT_EQ(seat.plans[1].activities().size(), 2U);
  ASSERT_EQ(seat.commands.size(), 3U);
  EXPECT_EQ(seat.commands[1].epoch(), 1U);
  EXPECT_EQ(seat.commands[2].action(), v1::COMMAND_QUERY);
  EXPECT_EQ(seat.commands[2].activity(), seat.commands[1].activity());
  EXPECT_EQ(seat.commands[2].epoch(), 1U) << "asked under the key of its issue";
  EXPECT_EQ(seat.commands[2].sender_epoch(), 2U);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.mission.goals_achieved(), 2U);
  EXPECT_EQ(seat.journal().goals().size(), 2U);
}

// What has moved a timeline while the executive was gone is newer than what it knew of it.
TEST(ExecService, ARestartTellsWhatTheGroundHasSetAsOfTheTimeToWhichTheRecordGoes) {
  const auto mission = std::filesystem::temp_directory_path() / ("roci_told_" + std::to_string(::getpid()));
  std::filesystem::copy(ROCI_SOURCE_DIR "/missions/planetary", mission,
                        std::filesystem::copy_options::recursive);
  std::ofstream(mission / "mission.yaml", std::ios::app) << "ground: {values: [door]}\n";
  {
    ExecSeat seat("inproc", "inproc", services::next_domain(), {}, mission);
    const auto orders = services::advertise(seat.robot(), services::topics::order);
    std::vector<std::int64_t> sampled_us;
    services::subscribe(seat.robot(), services::topics::observation, [&](const v1::Observation& told) {
      if (told.timeline() == "door") sampled_us.push_back(told.sampled_us());
    });
    seat.send(5s, photo_goal("first"));
    seat.at(10s, [&] {
      v1::Order set;
      set.issuer("ground");
      set.id("opens");
      set.order_kind(v1::ORDER_SET_VALUE);
      set.target("door");
      set.content(services::wire::to_wire(temporal::Value(temporal::state("open"))));
      orders.write(std::move(set));
    });
    seat.kill_executive_at(30s);
    seat.run_until(100s);
    ASSERT_THAT(sampled_us, SizeIs(2)) << "when it is set, and after the restart";
    EXPECT_GE(sampled_us[1], sampled_us[0]);
    EXPECT_LE(sampled_us[1], 30'000'000);
  }
  std::filesystem::remove_all(mission);
}

// A planner call dies with who made it.
TEST(ExecService, ARestartDuringAPlannerCallMakesItAgain) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  seat.kill_executive_at(10s + 200ms);
  seat.run_until(200s);
  EXPECT_EQ(seat.planner_calls, 2);
  EXPECT_EQ(seat.plans.at(0).version(), 1U);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
}

// Who was there before and is there under the same incarnation never left; another incarnation has forgotten
// everything.
TEST(ExecService, AfterARestartAServiceThatWasStartedAnewMeanwhileIsNoticed) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  seat.at(29s, [&] { seat.events.clear(); });
  seat.kill_both_at(30s);
  seat.run_until(200s);
  EXPECT_THAT(seat.events, Contains("service.lost").Times(1));
  EXPECT_THAT(seat.events, Contains("service.found").Times(1));
  EXPECT_EQ(seat.mission.outcome(), "achieved");
}

// A journal that another version of the code wrote: goals, the numbers of plans and a later epoch stay; the
// robot is brought to rest and the rest is planned anew.
TEST(ExecService, AJournalThatLeadsElsewhereKeepsTheGoals) {
  ExecSeat seat;
  seat.send(10s, photo_goal("first"));
  seat.send(10s, photo_goal("second"));
  seat.at(79s, [&] {
    Journal journal = seat.journal();
    journal.append(79s, "event", "plan.broken by what this code never decides");
    journal.commit();
  });
  seat.kill_executive_at(80s);
  seat.run_until(500s);
  EXPECT_THAT(seat.events, Contains("journal.diverged"));
  EXPECT_THAT(seat.events, Contains("plan.wanted").Times(2));
  ASSERT_EQ(seat.plans.size(), 2U);
  EXPECT_EQ(seat.plans[1].version(), 2U);
  EXPECT_EQ(seat.plans[1].activities().size(), 1U) << "the first goal is achieved and stays so";
  EXPECT_EQ(seat.commands.back().epoch(), 2U);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.mission.goals_achieved(), 2U);
}

// Whoever asked may be gone when the executive comes back.
TEST(ExecService, GoalsOfTheJournalAloneAreFinished) {
  GoalRecord record;
  record.request = photo("ridge");
  record.state = GoalState::planned;
  record.arrival = 1;
  ExecSeat seat("inproc", "inproc", services::next_domain(), {record});
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.mission.goals_achieved(), 1U);
}

// The journal was lost, or never had what an earlier executive of this name did.
TEST(ExecService, AnOwnersLaterEpochIsTakenDurablyAndTheCommandSaidAgain) {
  ExecSeat seat;
  seat.held_epoch = 7;
  seat.send(10s, photo_goal("ridge"));
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.planner_calls, 1);
  EXPECT_THAT(seat.events, Contains("epoch.taken").Times(1));
  ASSERT_EQ(seat.commands.size(), 2U);
  EXPECT_EQ(seat.commands[0].epoch(), 1U);
  EXPECT_EQ(seat.commands[1].activity(), seat.commands[0].activity());
  EXPECT_EQ(seat.commands[1].attempt(), seat.commands[0].attempt()) << "a retry is for what was tried";
  EXPECT_EQ(seat.commands[1].epoch(), 8U) << "a key that nobody has used";
  EXPECT_EQ(seat.commands[1].sender_epoch(), 8U);
  EXPECT_EQ(seat.journal().number("epoch", 0), 8);
}

TEST(ExecService, ARestartAsksAgainUnderTheOldKeyInTheLaterEpoch) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  seat.at(29s, [&] { seat.held_epoch = 7; });
  seat.kill_executive_at(30s);
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  ASSERT_EQ(seat.commands.size(), 3U);
  for (const std::size_t query : {1U, 2U}) {
    EXPECT_EQ(seat.commands[query].action(), v1::COMMAND_QUERY);
    EXPECT_EQ(seat.commands[query].epoch(), 1U);
  }
  EXPECT_EQ(seat.commands[1].sender_epoch(), 2U);
  EXPECT_EQ(seat.commands[2].sender_epoch(), 8U);
}

TEST(ExecService, AnEpochFarAheadIsReachedInBoundedSteps) {
  ExecSeat seat;
  seat.held_epoch = 2500;
  seat.send(10s, photo_goal("ridge"));
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  std::vector<std::uint64_t> epochs;
  for (const v1::Command& command : seat.commands) epochs.push_back(command.sender_epoch());
  EXPECT_THAT(epochs, ElementsAre(1U, 1002U, 2003U, 2501U));
}

TEST(ExecService, AForgedEpochOfNoCommandChangesNothing) {
  ExecSeat seat;
  seat.send(10s, photo_goal("ridge"));
  const auto acks = services::advertise(seat.robot(), services::topics::command_ack);
  seat.at(5s, [&] {
    v1::CommandAck forged;
    forged.commander("exec_svc");
    forged.epoch(1);
    forged.activity("p9.1-image");
    forged.attempt(1);
    forged.owner("sim_svc");
    forged.newest_epoch(1'000'000);
    forged.refused_epoch(true);
    acks.write(forged);
  });
  seat.run_until(200s);
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  EXPECT_EQ(seat.commands.at(0).epoch(), 1U);
}

TEST(ExecService, WhatAnotherServiceAcknowledgesInTheOwnersPlaceIsNotBelieved) {
  ExecSeat seat;
  seat.acknowledged_by = "arm_svc";
  seat.send(10s, photo_goal("ridge"));
  seat.run_until(60s);
  EXPECT_THAT(seat.events, Contains("ack.foreign").Times(1));
}

TEST(ExecService, ATimelineHasOneSource) {
  ExecSeat seat;
  services::Node& planner = seat.run().node("planner_svc");
  const auto forged = services::advertise(planner, services::topics::observation);
  planner.at(60s, [&] {
    v1::Observation observation;
    observation.timeline("rover.camera");
    observation.observed().kind(v1::VALUE_STATE);
    observation.observed().state("imaging");
    forged.write(observation);
    forged.write(observation);
  });
  seat.send(10s, photo_goal("ridge"));
  seat.send(70s, photo_goal("later"));
  seat.run_until(200s);
  EXPECT_THAT(seat.events, Contains("timeline.contested").Times(1));
  EXPECT_EQ(seat.mission.outcome(), "achieved");
  for (const v1::Command& command : seat.commands) EXPECT_NE(command.command_name(), "stop");
}

TEST(ExecService, ARestartTellsTheStateOfEveryGoalAgain) {
  ExecSeat seat;
  v1::Goal bad = photo_goal("bad");
  bad.goal_kind("photograph");
  seat.send(10s, photo_goal("done"));
  seat.send(10s, bad);
  seat.at(100s, [&] { seat.statuses.clear(); });
  seat.kill_executive_at(101s);
  seat.run_until(200s);
  EXPECT_THAT(seat.statuses,
              ElementsAre("done achieved observed", StartsWith("bad rejected unknown goal kind")));
  EXPECT_EQ(seat.planner_calls, 1);
  EXPECT_EQ(seat.mission.outcome(), "partial");
}

// An executive of months keeps the last words on its newest goals for late joiners, and on all that are open.
TEST(ExecService, ALateJoinerHearsOfTheGoalsThatAreOpenOrEndedLast) {
  constexpr std::size_t kEnded = 200, kTold = 64;
  std::vector<GoalRecord> journalled;
  for (std::size_t number = 1; number <= kEnded; ++number) {
    GoalRecord record;
    record.request = photo("g" + std::to_string(number));
    record.state = GoalState::achieved;
    record.arrival = number;
    journalled.push_back(record);
  }
  ExecSeat seat("inproc", "inproc", services::next_domain(), journalled);
  std::set<std::string> heard;
  seat.send(10s, photo_goal("open"));
  seat.kill_planner_at(20s, [&](services::Node& node) {
    services::subscribe(node, services::topics::goal_status,
                        [&](const v1::GoalStatus& status) { heard.insert(status.id()); });
  });
  seat.run_until(30s);
  EXPECT_EQ(seat.mission.goals_achieved(), kEnded);
  EXPECT_EQ(heard.size(), kTold + 1);
  EXPECT_THAT(heard, Contains("open"));
  EXPECT_THAT(heard, Contains("g" + std::to_string(kEnded)));
  EXPECT_THAT(heard, ::testing::Not(Contains("g1")));
}

}  // namespace
}  // namespace roci::exec
