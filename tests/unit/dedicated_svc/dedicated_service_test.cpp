// A dedicated executive between whoever commands it and two subsystems, on nodes of their own (R145, R146).
#include "dedicated_svc/dedicated_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>

#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/dedicated_svc/wheels.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::dedicated {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace topics = services::topics;

constexpr char kMission[] = R"(
format: 1
name: yard
objects:
  - {name: w1, type: waypoint, properties: {x: 3, y: 4}}
dedicated:
  timeline: scout.locomotion
  subsystem: locomotion
  methods:
    Traverse:
      arguments: [wp]
      calls:
        - {name: path, path: {planner: nav, from: {robot: scout}, to: {object: "{wp}"}}}
        - {name: drive, command: {owner: wheels, robot: scout, subsystem: nav, name: drive, arguments: {to: "{wp}"}}, within_s: 100}
      repairs:
        no-go: {calls: [{name: map, command: {owner: wheels, robot: scout, subsystem: map, name: share}}], then: path}
      results: {length_m: "{path.length_m}"}
      during: [traversing, "{wp}"]
      then: [at, "{wp}"]
      failed: {no-go: [hazard-detected], "*": [failed]}
    Stand:
      calls:
        - {name: spot, transform: {place: {robot: scout, ahead_m: 2, left_m: 1}, robot: scout}, check: {world_x: {at_least: 2, at_most: 2}}}
        - {name: seen, observe: {timeline: ground.window, is: [true]}}
      results: {y: "{spot.world_y}", left: "{spot.y}"}
    Follow:
      calls:
        - {name: here, path: {planner: nav, from: {robot: scout}, to: {object: w1}}}
        - {name: on, path: {planner: nav, from: {object: w1}, to: {x: "9", y: "4"}, short_m: 1.25}, check: {length_m: {at_least: 6, at_most: 6}, end_x: {at_least: 7.75, at_most: 7.75}, end_y: {at_least: 4, at_most: 4}, end_heading_rad: {at_least: 0, at_most: 0}}}
        - {name: short, path: {planner: nav, from: {robot: scout}, to: {object: w1}, short_m: 99}, check: {length_m: {at_least: 5}, end_x: {at_most: 0}, end_heading_rad: {at_least: 0.5, at_most: 0.5}}}
        - {name: drive, command: {owner: wheels, robot: scout, subsystem: nav, name: drive, arguments: {to: w1, way: "{here.way};{on.way};{short.way}"}}}
    Merge:
      calls:
        - {name: m, command: {owner: wheels, robot: scout, subsystem: map, name: merge}}
        - {name: a, path: {planner: nav, from: {robot: scout}, to: {object: w1}, map_within_s: 20, merged: m}}
        - {name: wait, wait_s: 0.000001}
        - {name: b, path: {planner: nav, from: {robot: scout}, to: {object: w1}, map_within_s: 20, merged: m}}
    Look:
      calls:
        - {name: seen, observe: {timeline: scout.nav, is: [idle-at, w1]}, within_s: 50}
)";

class DedicatedServiceTest : public testing::Test {
 protected:
  DedicatedServiceTest()
      : folder_(std::filesystem::temp_directory_path() / ("roci-dedicated-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "mission.yaml") << kMission;
    settings_.mission = folder_;
    settings_.run_folder = folder_;
  }
  ~DedicatedServiceTest() override { std::filesystem::remove_all(folder_); }

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
    if (name == "Traverse") {
      v1::Property wp;
      wp.name("wp");
      wp.value("w1");
      out.arguments().push_back(wp);
    }
    return out;
  }

  static void stand_at_origin(const services::Publisher<v1::Observation>& states) {
    for (const char* axis : {"x", "y", "heading"}) {
      v1::Observation seen;
      seen.timeline(std::string("scout.") + axis);
      seen.observed().kind(v1::VALUE_NUMBER);
      seen.observed().number(0);
      states.write(seen);
    }
  }

  // What is said to these commands, each sent at its time, and what the timeline shows: "<s> …".
  std::vector<std::string> talk(std::multimap<temporal::Duration, v1::Command> commands,
                                std::deque<std::string> script = {"done"},
                                v1::MotionOutcome path = v1::MOTION_FOUND,
                                const std::function<void(services::Node& master)>& also = {}) {
    std::filesystem::remove(folder_ / "loco.calls");
    services::SimRun run({"master", "wheels", "nav", "loco"});
    services::Node& master = run.add("master");
    services::Node& wheels_node = run.add("wheels");
    services::Node& nav = run.add("nav");
    Wheels wheels(wheels_node, std::move(script));
    services::serve(nav, topics::path_request, [&](const v1::PathRequest& request, auto responder) {
      v1::PathReply reply;
      reply.outcome(path);
      reply.reason("said nav");
      reply.length_m(std::hypot(request.goal_pose().x_m() - request.origin().x_m(),
                                request.goal_pose().y_m() - request.origin().y_m()));
      reply.waypoints({request.origin(), request.goal_pose()});
      reply.waypoints()[0].heading_rad(0.5);
      if (points_ > 0) reply.waypoints().resize(points_, request.goal_pose());
      responder.reply(std::move(reply));
    });
    const auto dedicated = make_service(run.add("loco"), settings_);
    std::vector<std::string> heard;
    const auto note = [&](const std::string& what) {
      heard.push_back(std::to_string(master.now() / 1s) + " " + what);
    };
    services::subscribe(master, topics::command_ack, [&](const v1::CommandAck& ack) {
      static const std::vector<std::string> stages{"accepted",  "rejected",      "completed", "failed",
                                                   "cancelled", "cancel-failed", "unknown"};
      if (ack.owner() != "loco") return;
      reasons_.push_back(ack.reason());
      std::string results;
      for (const v1::NamedValue& one : ack.outcome().measured())
        if (one.name() != "duration_s")
          results += " " + one.name() + "=" + std::to_string(one.held().number()).substr(0, 3);
      note(ack.activity() + " " + stages.at(ack.stage()) + (ack.code().empty() ? "" : " " + ack.code()) +
           results);
    });
    services::subscribe(master, topics::observation, [&](const v1::Observation& seen) {
      if (seen.timeline() == "scout.locomotion") note(seen.observed().state());
    });
    const auto sender = services::advertise(master, topics::command);
    const auto states = services::advertise(master, topics::observation);
    master.at(0s, [&] { stand_at_origin(states); });
    if (also) also(master);
    for (const auto& [at, one] : commands) master.at(at, [&sender, one = one] { sender.write(one); });
    master.after(400s, [&master] { master.stop(); });
    run.run();
    begun_ = wheels.begun;
    ways_ = wheels.ways;
    return heard;
  }

  std::filesystem::path folder_;
  services::RunSettings settings_;
  std::vector<std::string> begun_, ways_, reasons_;
  std::size_t points_ = 0;  // of each path; 0: its two ends
};

TEST_F(DedicatedServiceTest, CarriesAMethodOutAndTellsWhatItBrought) {
  EXPECT_THAT(
      talk({{1s, command("a", "Traverse")}}),
      ElementsAre("0 idle", "1 a accepted", "1 traversing", "21 a completed done length_m=5.0", "21 at"));
  EXPECT_THAT(begun_, ElementsAre("scout.nav drive master/1/a/2"));
}

TEST_F(DedicatedServiceTest, AWayIsCutShortJoinedAndHandedOn) {
  EXPECT_THAT(talk({{1s, command("a", "Follow")}}), Contains("21 a completed done"));
  EXPECT_THAT(ways_, ElementsAre("0,0;3,4;3,4;7.75,4;0,0"));
}

TEST_F(DedicatedServiceTest, AWayOfTooManyPointsIsNotBrought) {
  points_ = 257;
  EXPECT_THAT(talk({{1s, command("a", "Traverse")}}), Contains("21 a completed done length_m=5.0"));
  EXPECT_THAT(talk({{1s, command("b", "Follow")}}), Contains(HasSubstr("1 b failed wrong-value")));
  EXPECT_THAT(ways_, IsEmpty());
}

TEST_F(DedicatedServiceTest, APathOnAMapThatWasToldTooLongAgoIsNoPath) {
  EXPECT_THAT(talk({{1s, command("a", "Merge")}}), Contains(HasSubstr("21 a failed map-too-old")));
  EXPECT_THAT(reasons_,
              Contains("b: the newest map that was merged is 20.000001 s old, and may be 20.000000 s"));
}

TEST_F(DedicatedServiceTest, AFailedCallFailsTheCommandWithItsCode) {
  EXPECT_THAT(talk({{1s, command("a", "Traverse")}}, {"stalled"}),
              ElementsAre("0 idle", "1 a accepted", "1 traversing", "21 a failed stalled", "21 failed"));
  EXPECT_THAT(talk({{1s, command("b", "Traverse")}}, {"done"}, v1::MOTION_UNREACHABLE),
              Contains(HasSubstr("1 b failed no-path")));
  EXPECT_THAT(begun_, IsEmpty()) << "without a path nobody drives";
}

// R146: above nothing is seen of it but the status.
TEST_F(DedicatedServiceTest, ARepairWithinTheTimeEndsAsASuccess) {
  EXPECT_THAT(talk({{1s, command("a", "Traverse", v1::COMMAND_EXECUTE, 100'000'000)}}, {"no-go", "done"}),
              ElementsAre("0 idle", "1 a accepted", "1 traversing", "21 a accepted repairing",
                          "61 a completed done length_m=5.0", "61 at"));
  EXPECT_THAT(begun_, ElementsAre("scout.nav drive master/1/a/2", "scout.map share master/1/a/3",
                                  "scout.nav drive master/1/a/5"));
}

TEST_F(DedicatedServiceTest, ARepairEndsAtTheLatestEndOfItsStep) {
  EXPECT_THAT(talk({{1s, command("a", "Traverse", v1::COMMAND_EXECUTE, 61'000'000)}}, {"no-go", "done"}),
              Contains("61 a completed done length_m=5.0"));
  EXPECT_THAT(talk({{1s, command("b", "Traverse", v1::COMMAND_EXECUTE, 60'999'999)}}, {"no-go", "done"}),
              ElementsAre("0 idle", "1 b accepted", "1 traversing", "21 b accepted repairing",
                          "61 b failed repair-overrun", "61 failed"));
  EXPECT_THAT(
      talk({{1s, command("c", "Traverse", v1::COMMAND_EXECUTE, 20'000'000)}}, {"no-go", "done"}),
      ElementsAre("0 idle", "1 c accepted", "1 traversing", "21 c failed no-go", "21 hazard-detected"))
      << "its time was over before the repair could begin";
}

TEST_F(DedicatedServiceTest, ACallThatTakesTooLongIsCancelled) {
  EXPECT_THAT(
      talk({{1s, command("a", "Traverse")}}, {"for-ever"}),
      ElementsAre("0 idle", "1 a accepted", "1 traversing", "101 a failed call-timeout", "101 failed"));
  EXPECT_THAT(talk({{1s, command("b", "Look")}}), Contains("51 b failed call-timeout"));
}

TEST_F(DedicatedServiceTest, WaitsForAnObservation) {
  EXPECT_THAT(talk({{1s, command("a", "Look")}}, {"done"}, v1::MOTION_FOUND,
                   [](services::Node& master) {
                     for (const auto& [at, place] : {std::pair{10s, "w0"}, std::pair{30s, "w1"}})
                       master.at(at, [&master, place = std::string(place)] {
                         v1::Observation seen;
                         seen.timeline("scout.nav");
                         seen.observed().kind(v1::VALUE_STATE);
                         seen.observed().state("idle-at");
                         seen.observed().arguments().push_back(place);
                         services::advertise(master, topics::observation).write(seen);
                       });
                   }),
              Contains("30 a completed done"));
}

TEST_F(DedicatedServiceTest, FindsAPlaceBesideARobotAndWaitsForATruth) {
  EXPECT_THAT(talk({{1s, command("a", "Stand")}}, {"done"}, v1::MOTION_FOUND,
                   [](services::Node& master) {
                     for (const auto& [at, open] : {std::pair{10s, false}, std::pair{30s, true}})
                       master.at(at, [&master, open = open] {
                         v1::Observation seen;
                         seen.timeline("ground.window");
                         seen.observed().kind(v1::VALUE_BOOLEAN);
                         seen.observed().truth(open);
                         services::advertise(master, topics::observation).write(seen);
                       });
                   }),
              Contains("30 a completed done left=1.0 y=1.0"));
}

TEST_F(DedicatedServiceTest, ACancelAndAStopEndTheCallFirst) {
  EXPECT_THAT(
      talk({{1s, command("a", "Traverse")}, {5s, command("a", "", v1::COMMAND_CANCEL)}}, {"for-ever"}),
      ElementsAre("0 idle", "1 a accepted", "1 traversing", "5 a cancelled cancelled", "5 failed"));
  EXPECT_THAT(talk({{1s, command("b", "Traverse")}, {5s, command("s", "stop")}}, {"for-ever"}),
              Contains("5 b cancelled stopped"));
}

TEST_F(DedicatedServiceTest, RefusesWhatItCannotDo) {
  v1::Command without = command("c", "Traverse");
  without.arguments().clear();
  EXPECT_THAT(talk({{1s, command("a", "Traverse")},
                    {2s, command("b", "Look")},
                    {3s, without},
                    {4s, command("d", "Travers")}}),
              testing::IsSupersetOf(
                  {"2 b rejected busy", "3 c rejected wrong-arguments", "4 d rejected unknown-command"}));
}

TEST_F(DedicatedServiceTest, ASubsystemThatDiesFailsTheCommand) {
  EXPECT_THAT(talk({{1s, command("a", "Traverse")}}, {"dies"}), Contains("6 a failed owner-lost"));
}

}  // namespace
}  // namespace roci::dedicated
