// A dedicated executive that dies and comes back (R145): it asks its subsystems what became of its calls, and goes on
// with the method where it stood, if whoever commanded it still wants it; nothing is done twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "dedicated_svc/dedicated_service.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/dedicated_svc/wheels.hpp"

namespace roci::dedicated {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
namespace topics = services::topics;

constexpr char kTwoMethods[] = R"(
format: 1
name: yard
objects:
  - {name: w1, type: waypoint, properties: {x: 3, y: 4}}
dedicated:
  timeline: scout.locomotion
  subsystem: locomotion
  methods:
    Tour:
      calls:
        - {name: out, command: {owner: wheels, robot: scout, subsystem: nav, name: drive, arguments: {to: w1}}}
        - {name: rest, wait_s: 7}
        - {name: spot, transform: {place: {object: w1}, robot: scout}}
        - {name: path, path: {planner: nav, from: {robot: scout}, to: {object: w1}}}
        - {name: back, command: {owner: wheels, robot: scout, subsystem: nav, name: back, arguments: {way: "{path.way}"}}}
      results: {range_m: "{spot.range_m}"}
      then: [home]
      failed: {"*": [lost]}
    Mend:
      calls:
        - {name: drive, command: {owner: wheels, robot: scout, subsystem: nav, name: drive}, within_s: 30}
      repairs:
        no-go:
          calls:
            - {name: map, command: {owner: wheels, robot: scout, subsystem: map, name: share}}
            - {name: seen, observe: {timeline: scout.x}}
          needs: {scout.x: {at_most: 1}}
      then: [home]
      failed: {"*": [lost]}
)";

class Death : public testing::Test {
 protected:
  Death() : folder_(std::filesystem::temp_directory_path() / ("roci-death-" + std::to_string(getpid()))) {
    settings_.mission = folder_;
    settings_.run_folder = folder_;
  }
  ~Death() override { std::filesystem::remove_all(folder_); }

  struct Flight {
    std::vector<std::string> heard;      // "<s> <activity> <stage> <code>" of loco, and its states
    std::vector<std::string> commanded;  // what the wheels took, in order
    std::vector<std::string> ways;
    std::vector<std::string> cancelled;
    int writes = 0;
  };
  struct Plan {
    std::string method = "Tour";
    std::deque<std::string> script = {"done"};
    std::int64_t latest_end_us = -1;
    int dies_around_write = 0;  // counted from 1; 0: it does not
    temporal::Duration dies_at{0};
    bool asks = true;  // what became of it, all the time
    std::multimap<temporal::Duration, v1::Command> also{};
  };

  static v1::Command command(const std::string& activity, const std::string& name,
                             v1::CommandAction action = v1::COMMAND_EXECUTE,
                             std::int64_t latest_end_us = -1) {
    v1::Command out;
    out.commander("master");
    out.activity(activity);
    out.attempt(1);
    out.action(action);
    out.owner("loco");
    out.robot("scout");
    out.subsystem("locomotion");
    out.command_name(name);
    out.epoch(1);
    out.sender_epoch(1);
    out.latest_end_us(latest_end_us);
    return out;
  }

  Flight fly(const Plan& plan) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "mission.yaml") << kTwoMethods;
    Flight flight;
    services::SimRun run({"master", "wheels", "nav", "loco"});
    run.master.restart_hold_s = 1000;
    services::Node& master = run.add("master");
    Wheels wheels(run.add("wheels"), plan.script);
    services::serve(run.add("nav"), topics::path_request, [](const v1::PathRequest& request, auto responder) {
      v1::PathReply reply;
      reply.waypoints({request.origin(), request.goal_pose()});
      responder.reply(std::move(reply));
    });
    const auto note = [&](const std::string& what) {
      flight.heard.push_back(std::to_string(master.now() / 1s) + " " + what);
    };
    services::subscribe(master, topics::command_ack, [&](const v1::CommandAck& ack) {
      static const std::vector<std::string> stages{"accepted",  "rejected",      "completed", "failed",
                                                   "cancelled", "cancel-failed", "unknown"};
      if (ack.owner() == "loco" && ack.stage() != v1::STAGE_ACCEPTED)
        note(ack.activity() + " " + stages.at(ack.stage()) + " " + ack.code());
    });
    services::subscribe(master, topics::observation, [&](const v1::Observation& seen) {
      if (seen.timeline() == "scout.locomotion") note(seen.observed().state());
    });
    const auto sender = services::advertise(master, topics::command);
    const auto states = services::advertise(master, topics::observation);
    master.at(0s, [&] {
      for (const char* axis : {"x", "y", "heading"}) {
        v1::Observation seen;
        seen.timeline(std::string("scout.") + axis);
        seen.observed().kind(v1::VALUE_NUMBER);
        seen.observed().number(0);
        states.write(seen);
      }
    });
    master.at(1s, [&] { sender.write(command("a", plan.method, v1::COMMAND_EXECUTE, plan.latest_end_us)); });
    for (const auto& [at, one] : plan.also) master.at(at, [&sender, one = one] { sender.write(one); });
    for (int s = 3; plan.asks && s < 100; s += 3)
      master.at(s * 1s, [&] { sender.write(command("a", "", v1::COMMAND_QUERY)); });
    master.at(100s, [&] { master.stop(); });
    services::Node& first = run.add("loco");
    const auto before = make_watched_service(first, settings_, [&] {
      if (++flight.writes == plan.dies_around_write) throw services::Crash{};
    });
    if (plan.dies_at > 0s) first.at(plan.dies_at, [] { throw services::Crash{}; });
    std::unique_ptr<services::Service> after;
    if (plan.dies_around_write > 0 || plan.dies_at > 0s) {
      run.start();
      run.wait_for_crash("loco");
      if (damage_) std::ofstream(folder_ / "loco.calls") << "{";
      after = make_service(run.add("loco", 2), settings_);
    }
    run.run();
    flight.commanded = wheels.begun;
    flight.ways = wheels.ways;
    flight.cancelled = wheels.cancelled;
    return flight;
  }

  // What the answer to the command is, said again and again as it is asked for.
  static std::string outcome(const Flight& flight) {
    std::string last;
    for (const std::string& line : flight.heard)
      if (const auto at = line.find(" a "); at != std::string::npos) last = line.substr(at + 1);
    return last;
  }

  // Dies before and after each write of its record, and goes on each time as if it had not.
  void dies_around_each_write(Plan plan) {
    const Flight whole = fly(plan);
    ASSERT_GT(whole.writes, 8);
    for (int write = 1; write <= whole.writes; ++write) {
      plan.dies_around_write = write;
      const Flight flight = fly(plan);
      const std::string when =
          (write % 2 ? "before write " : "after write ") + std::to_string((write + 1) / 2);
      if (write == 1) {  // it had taken the command, and written nothing else of it
        EXPECT_EQ(outcome(flight), "a failed owner-restarted");
        EXPECT_TRUE(flight.commanded.empty());
        continue;
      }
      EXPECT_EQ(outcome(flight), outcome(whole)) << when;
      EXPECT_EQ(flight.commanded, whole.commanded) << when << ": each once, in order";
      EXPECT_EQ(flight.ways, whole.ways) << when;
    }
  }

  const std::filesystem::path folder_;
  services::RunSettings settings_;
  bool damage_ = false;
};

TEST_F(Death, AroundEachWriteTheMethodGoesOnWhereItStood) {
  dies_around_each_write({});
  const Flight whole = fly({});
  EXPECT_EQ(outcome(whole), "a completed done");
  EXPECT_THAT(whole.commanded, ElementsAre("scout.nav drive master/1/a/1", "scout.nav back master/1/a/5"));
  EXPECT_THAT(whole.ways, ElementsAre("0,0;3,4"));
}

TEST_F(Death, AroundEachWriteARepairGoesOn) {
  dies_around_each_write({.method = "Mend", .script = {"no-go", "done"}, .latest_end_us = 150'000'000});
}

TEST_F(Death, AroundEachWriteOfAFailureTheFailureIsTold) {
  dies_around_each_write({.script = {"done", "stalled"}});
  EXPECT_EQ(outcome(fly({.script = {"done", "stalled"}})), "a failed stalled");
}

TEST_F(Death, AtEachSecondTheMethodGoesOnWhereItStood) {
  const Flight whole = fly({});
  for (int s = 2; s < 55; s += 6) {
    const Flight flight = fly({.dies_at = s * 1s});
    EXPECT_EQ(outcome(flight), "a completed done") << s;
    EXPECT_EQ(flight.commanded, whole.commanded) << s;
  }
}

TEST_F(Death, AWaitIsNotWaitedTwice) {
  EXPECT_THAT(fly({}).heard, Contains("48 a completed done"));
  EXPECT_THAT(fly({.dies_at = 24s}).heard, Contains("48 a completed done"));
}

TEST_F(Death, AMethodForWhichNobodyAsksHasFailedAndWhatItCommandedIsEnded) {
  const Flight flight = fly({.dies_at = 10s, .asks = false});
  EXPECT_THAT(flight.heard,
              ElementsAre("0 idle", "1 Tour", "10 Tour", "20 a failed owner-restarted", "20 lost"));
  EXPECT_THAT(flight.commanded, ElementsAre("scout.nav drive master/1/a/1"));
  EXPECT_THAT(flight.cancelled, ElementsAre("master/1/a/1"));
}

// Who commands something new wants the old no more.
TEST_F(Death, WhatStillRunsIsEndedBeforeAnythingNewBegins) {
  Plan plan{.dies_at = 10s, .asks = false};
  plan.also.emplace(13s, command("b", "Mend"));
  const Flight flight = fly(plan);
  EXPECT_THAT(flight.heard, ElementsAre("0 idle", "1 Tour", "10 Tour", "13 a failed owner-restarted",
                                        "13 lost", "13 Mend", "33 b completed done", "33 home"));
  EXPECT_THAT(flight.commanded, ElementsAre("scout.nav drive master/1/a/1", "scout.nav drive master/1/b/1"));
  EXPECT_THAT(flight.cancelled, ElementsAre("master/1/a/1"));
}

TEST_F(Death, AStopOutlivesIt) {
  Plan plan;
  plan.also.emplace(10s, command("s", "stop"));
  const Flight whole = fly(plan);
  EXPECT_EQ(outcome(whole), "a cancelled stopped");
  for (int write = 3; write <= whole.writes; ++write) {
    plan.dies_around_write = write;
    const Flight flight = fly(plan);
    // Of a command that was being taken it is not known whether it was a stop, so nothing goes on.
    EXPECT_EQ(outcome(flight), write == 5 || write == 6 ? "a failed owner-restarted" : "a cancelled stopped")
        << write;
    EXPECT_EQ(flight.commanded, whole.commanded) << write;
  }
}

TEST_F(Death, AStopThatComesBeforeItGoesOnEndsIt) {
  Plan plan{.dies_at = 10s, .asks = false};
  plan.also.emplace(12s, command("s", "stop"));
  const Flight flight = fly(plan);
  EXPECT_THAT(flight.heard, testing::IsSupersetOf({"12 a cancelled stopped", "12 s completed done"}));
  EXPECT_THAT(flight.cancelled, ElementsAre("master/1/a/1"));
}

TEST_F(Death, ARepairWhoseTimeIsOverMeanwhileEndsAsOverrun) {
  const Flight flight =
      fly({.method = "Mend", .script = {"no-go", "done"}, .latest_end_us = 31'000'000, .dies_at = 30s});
  EXPECT_EQ(outcome(flight), "a failed repair-overrun");
  EXPECT_THAT(flight.cancelled, ElementsAre("master/1/a/2"));
}

TEST_F(Death, ACallThatHasTakenTooLongMeanwhileIsCancelled) {
  const Flight flight = fly({.method = "Mend", .script = {"for-ever"}, .dies_at = 30s});
  EXPECT_EQ(outcome(flight), "a failed call-timeout");
  EXPECT_THAT(flight.cancelled, ElementsAre("master/1/a/1"));
}

TEST_F(Death, WhereItRestsIsKnownAfterwards) {
  EXPECT_THAT(fly({.dies_at = 80s, .asks = false}).heard,
              ElementsAre("0 idle", "1 Tour", "48 a completed done", "48 home", "80 home"));
}

TEST_F(Death, ADamagedRecordLosesTheMethodAndNothingElse) {
  damage_ = true;
  const Flight flight = fly({.dies_at = 10s});
  EXPECT_EQ(outcome(flight), "a failed owner-restarted");
}

}  // namespace
}  // namespace roci::dedicated
