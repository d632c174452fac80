// Two rovers side by side: where they are, what they do, what their maps have; open decisions; what is being repaired.
#include "ground_console/cli/robots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ground_console/cli/reach.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/watch/screen.hpp"
#include "ground_console/lib/limits.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000;

v1::CommandAck word(v1::CommandStage stage, double s, const std::string& code = "",
                    const std::string& reason = "") {
  v1::CommandAck out;
  out.commander("exec_svc");
  out.epoch(1);
  out.activity("p1.1-scout");
  out.attempt(1);
  out.header(sent("scout.locomotion", static_cast<std::uint64_t>(s), s));
  out.header().robot("scout");
  out.stage(stage);
  out.owner("scout.locomotion");
  out.code(code);
  out.reason(reason);
  return out;
}

v1::Command command(double s, double latest_end_s) {
  v1::Command out;
  out.commander("exec_svc");
  out.epoch(1);
  out.activity("p1.1-scout");
  out.attempt(1);
  out.header(sent("exec_svc", 1, s));
  out.latest_end_us(latest_end_s < 0 ? -1 : static_cast<std::int64_t>(latest_end_s * 1e6));
  return out;
}

const lib::Repair& only(const lib::MissionView& view) { return *cli::repairs_of(view).at(0); }

TEST(Repairs, AreUnderWayUntilTheLastWordAndTellHowMuchOfTheirTimeIsUsed) {
  lib::MissionView view;
  view.take(command(15, 70));
  view.take(word(v1::STAGE_ACCEPTED, 15));
  EXPECT_THAT(cli::repairs_of(view), SizeIs(0)) << "it only began";
  view.take(word(v1::STAGE_ACCEPTED, 30, "repairing", "drive: fault"));
  view.take(observation("scout.wheels", "driving", 1));
  view.take(number("scout.battery", 1, 40));
  EXPECT_EQ(cli::repair_line(view, only(view)),
            "scout.locomotion repairs p1.1-scout since 00:00:30, 25 % of the time until 00:01:10 used: "
            "drive: fault");
  view.take(word(v1::STAGE_COMPLETED, 60));
  EXPECT_EQ(cli::repair_line(view, only(view)),
            "scout.locomotion repaired p1.1-scout from 00:00:30 to 00:01:00, mended, 75 % of the time until "
            "00:01:10 used: drive: fault");
  view.take(word(v1::STAGE_ACCEPTED, 61, "repairing", "drive: fault"));
  EXPECT_EQ(only(view).state, lib::Repair::State::mended) << "an answer to a question that came late";
}

TEST(Repairs, ThatFailSayWhyAndOneCommandMayHaveSeveral) {
  lib::MissionView view;
  view.take(word(v1::STAGE_ACCEPTED, 30, "repairing", "drive: fault"));
  view.take(word(v1::STAGE_ACCEPTED, 31, "repairing", "drive: fault"));
  view.take(word(v1::STAGE_ACCEPTED, 40, "repairing", "press: stuck"));
  view.take(word(v1::STAGE_FAILED, 50, "repair-overrun", "no time is left"));
  EXPECT_EQ(cli::repair_line(view, only(view)),
            "scout.locomotion repaired p1.1-scout from 00:00:30 to 00:00:50, failed: press: stuck (2 times); "
            "repair-overrun: no time is left");
  EXPECT_TRUE(cli::repairs_json(view)[0]["latest_end_s"].is_null());
  EXPECT_TRUE(cli::repairs_json(view)[0]["used"].is_null());
}

TEST(Repairs, OfWhomNobodyHeardTheCommandTellWhatWasPlanned) {
  lib::MissionView view;
  v1::MissionStatus status;
  view.take(status);
  v1::Plan plan;
  plan.version(1);
  v1::PlanActivity scout;
  scout.id("p1.1-scout");
  scout.duration_upper_us(70 * kSecond);
  plan.activities({scout});
  view.take(plan);
  view.take(step("p1.1-scout", v1::ACTIVITY_RUNNING, 1, 15, 15, -1));
  view.take(word(v1::STAGE_ACCEPTED, 30, "repairing", "drive: fault"));
  EXPECT_THAT(cli::repair_line(view, only(view)), HasSubstr("since 00:00:30, planned until 00:01:25: drive"));
  EXPECT_EQ(cli::repairs_json(view)[0]["planned_end_s"], 85);
}

TEST(Repairs, WithoutEndKeepWithinTheirBound) {
  lib::MissionView view;
  for (std::size_t i = 0; i < lib::kEntries + 5; ++i) {
    v1::CommandAck one = word(v1::STAGE_ACCEPTED, 1, "repairing", "x");
    one.activity("a" + std::to_string(i));
    view.take(one);
  }
  EXPECT_THAT(view.repairs(), SizeIs(lib::kEntries));
  EXPECT_EQ(view.unseen(), 5U);
}

v1::Heartbeat beat(const std::string& service, const std::string& robot) {
  v1::Heartbeat out;
  out.service(service);
  out.robot(robot);
  out.state(v1::SERVICE_RUNNING);
  return out;
}

v1::Observation state_of(const std::string& timeline, const std::string& state,
                         std::vector<std::string> arguments) {
  v1::Observation out = observation(timeline, state, 1);
  out.observed().arguments(std::move(arguments));
  return out;
}

v1::KnownMap known(const std::string& robot, std::vector<v1::MapObstacle> obstacles) {
  v1::KnownMap out;
  out.planner(robot + ".path");
  out.header(sent(robot + ".path", 1, 100));
  out.header().robot(robot);
  out.map_version(1 + obstacles.size());
  out.obstacles(std::move(obstacles));
  out.told_us(-1);
  return out;
}

v1::MapObstacle obstacle(const std::string& id, v1::ObstacleKind kind, double x, double y, double radius) {
  v1::MapObstacle out;
  out.found_by("scout");
  out.id(id);
  out.obstacle_kind(kind);
  out.x_m(x);
  out.y_m(y);
  out.radius_m(radius);
  out.found_us(90 * kSecond);
  return out;
}

// The scout has found soil and told it; the primary has taken that, and not yet the rock that was found after it.
lib::MissionView two_rovers() {
  lib::MissionView view;
  v1::MissionStatus status;
  status.header(sent("exec_svc", 1, 130));
  status.mission("faster");
  status.phase(v1::PHASE_EXECUTING);
  status.plan_version(1);
  view.take(status);
  view.take(goal_status("far", v1::GOAL_PLANNED, 1, "in plan 1"));
  view.take(beat("primary.path", "primary"));
  view.take(beat("scout.path", "scout"));
  for (int i = 0; i <= 10; ++i) {
    view.take(number("scout.x", 5 + 0.5 * i, 100 + i));
    view.take(number("scout.y", 15, 100 + i));
    view.take(number("primary.x", 4 + 0.2 * i, 100 + i));
    view.take(number("primary.y", 15, 100 + i));
  }
  view.take(number("scout.heading", M_PI / 2, 110));
  view.take(number("scout.battery", 350000, 110));
  view.take(state_of("scout.locomotion", "scouting", {"w0", "w1"}));
  view.take(state_of("scout.nav", "driving", {}));
  view.take(state_of("primary.locomotion", "at", {"w0"}));
  view.take(state_of("primary", "standby", {}));
  view.take(state_of("navigation", "team_cycle", {"w0", "w1"}));
  const v1::MapObstacle soil = obstacle("soil-1", v1::OBSTACLE_SOIL, 11, 15, 1.25);
  v1::KnownMap scout = known("scout", {soil, obstacle("rock-1", v1::OBSTACLE_ROCK, 14, 17, 0.5)});
  scout.told_version(2);
  scout.told_us(95 * kSecond);
  view.take(scout);
  v1::KnownMap primary = known("primary", {soil});
  v1::TakenPatch taken;
  taken.author("scout.path");
  taken.map_version(2);
  taken.taken_us(96 * kSecond);
  primary.taken({taken});
  view.take(primary);
  v1::Decision open;
  open.header(sent("exec_svc", 1, 100));
  open.id("p1.route");
  open.resolver("ground");
  open.choices({"straight", "south"});
  open.answer_before_us(200 * kSecond);
  view.take(open);
  view.take(command(120, 150));
  view.take(word(v1::STAGE_ACCEPTED, 125, "repairing", "drive: no-go"));
  return view;
}

TEST(Robots, StandInTheStatusSideBySideWithTheirMaps) {
  const json status = json::parse(cli::json_text(cli::status_json(two_rovers())));
  const json& scout = status["robots"]["scout"];
  EXPECT_EQ(scout["pose"]["x_m"], 10);
  EXPECT_NEAR(scout["pose"]["heading_rad"].get<double>(), 1.5708, 1e-3);
  EXPECT_EQ(scout["battery"], 350000);
  EXPECT_EQ(scout["states"]["locomotion"], "scouting w0 w1");
  ASSERT_THAT(scout["maps"], SizeIs(1));
  EXPECT_EQ(scout["maps"][0]["map_version"], 3);
  EXPECT_EQ(scout["maps"][0]["told"], (json{{"map_version", 2}, {"at_s", 95}}));
  const json& primary = status["robots"]["primary"];
  EXPECT_EQ(primary["doing"], "standby");
  EXPECT_TRUE(primary["battery"].is_null());
  ASSERT_THAT(primary["maps"][0]["obstacles"], SizeIs(1));
  EXPECT_EQ(primary["maps"][0]["obstacles"][0]["found_by"], "scout");
  EXPECT_EQ(primary["maps"][0]["obstacles"][0]["kind"], "soil");
  EXPECT_EQ(primary["maps"][0]["taken"][0],
            (json{{"author", "scout.path"}, {"map_version", 2}, {"at_s", 96}}));
  EXPECT_EQ(status["decisions"][0]["choices"], (json{"straight", "south"}));
  EXPECT_EQ(status["repairs"][0]["owner"], "scout.locomotion");
  EXPECT_EQ(status["repairs"][0]["state"], "under way");
  EXPECT_NEAR(status["repairs"][0]["used"].get<double>(), 0.2, 1e-9);
  EXPECT_EQ(status["timelines"]["scout.nav"], "driving") << "what stood there before still does";
}

TEST(Robots, StandInTheTextOfTheStatus) {
  cli::MissionWords words;
  words.units["*"] = "J";
  EXPECT_EQ(cli::robots_text(two_rovers(), words), R"(
Robots
  primary   standby   x 6.0 y 15.0 m
    locomotion        at w0
    map               version 2: 1 obstacle (1 soil of scout), took version 2 of scout.path at 00:01:36
  scout   x 10.0 y 15.0 m, heading 90°   battery 350 kJ
    locomotion        scouting w0 w1
    nav               driving
    map               version 3: 2 obstacles (1 rock of scout, 1 soil of scout), told version 2 at 00:01:35
  team
    navigation        team_cycle w0 w1

Decisions
  p1.route: straight or south? asked of ground, before 00:03:20

Repairs
  scout.locomotion repairs p1.1-scout since 00:02:05, 20 % of the time until 00:02:30 used: drive: no-go
)");
  EXPECT_EQ(cli::robots_text(lib::MissionView()), "");
}

TEST(Robots, AFamilyOfTimelinesIsOneWithItsNewest) {
  lib::MissionView view = two_rovers();
  const auto way = [&](const std::string& name, double s) {
    v1::Observation out = state_of("primary.way." + name, "open", {});
    out.sampled_us(static_cast<std::int64_t>(s * 1e6));
    view.take(out);
  };
  way("w0.w1", 30);
  way("w1.w2", 20);
  const auto states = [&] { return cli::states_by_family(view, cli::robots_of(view).at(0)); };
  EXPECT_THAT(states(), SizeIs(3)) << "two are no family";
  way("v1.v2", 15);
  EXPECT_THAT(states(),
              ::testing::ElementsAre(std::pair<std::string, std::string>{"locomotion", "at w0"},
                                     std::pair<std::string, std::string>{"way.*", "3, newest w0.w1 open"}));
}

TEST(Robots, OfAMissionWithOneAreThatOne) {
  const auto robots = cli::robots_of(flying_mission());
  ASSERT_THAT(robots, SizeIs(1));
  EXPECT_EQ(robots[0].name, "rover");
}

TEST(Robots, WhoseNumbersAreNoneAreShownWithout) {
  lib::MissionView view;
  view.take(number("scout.x", std::nan(""), 1));
  view.take(number("scout.y", 1, 1));
  view.take(known("scout", {obstacle("nan", v1::OBSTACLE_SOIL, std::nan(""), 1, INFINITY)}));
  view.take(known("primary", {obstacle("far", v1::OBSTACLE_SOIL, 1e200, -1e200, 1e200)}));
  EXPECT_FALSE(cli::robots_of(view).at(1).place);
  cli::watch::watch_screen(view, 120, 50);
  EXPECT_FALSE(json::parse(cli::json_text(cli::status_json(view))).is_discarded());
}

TEST(WatchScreen, ShowsTwoRoversSideBySide) {
  EXPECT_EQ(
      cli::watch::watch_screen(two_rovers(), 110, 48).plain(),
      R"(faster   00:02:10   executing   plan 1, 0 replans                                              q ends the view

Goals
A ◔ far          planned, in plan 1

▲ primary   standby                                     ▲ scout
x 6.0 y 15.0 m                                          x 10.0 y 15.0 m, heading 90°   battery 350000
locomotion at w0                                        locomotion scouting w0 w1   nav driving
map version 2: 1 obstacle (1 soil of scout), took       map version 3: 2 obstacles (1 rock of scout, 1 soil
version 2 of scout.path at 00:01:36                     of scout), told version 2 at 00:01:35
Its map  ├────────┤ 2 m   ▲ it △ other × rock ≈ soil    Its map  ├────────┤ 2 m   ▲ it △ other × rock ≈ soil

                                                                                                 ░░×░
                                                                                                  ░░
                            ░░░░░                                                   ░░░░░
                          ░░░░░░░░░                                               ░░░░░░░░░
·········▲               ░△░░░≈░░░░░                        · ·  △ · · · · · · · ░▲░░░≈░░░░░
                         ░░░░░░░░░░░                                             ░░░░░░░░░░░
                          ░░░░░░░░░                                               ░░░░░░░░░

Team  navigation team_cycle w0 w1

Decide    p1.route: straight or south? asked of ground, before 00:03:20
Repairs   scout.locomotion repairs p1.1-scout since 00:02:05, 20 % of the time until 00:02:30 used: drive: no-

Events






















)");
}

TEST(WatchScreen, OfTwoRoversKeepsWithinAnyTerminal) {
  const lib::MissionView view = two_rovers();
  for (std::size_t width = 1; width < 130; width += 7)
    for (std::size_t height = 1; height < 60; height += 5) {
      const std::string screen = cli::watch::watch_screen(view, width, height).plain();
      EXPECT_LE(static_cast<std::size_t>(std::ranges::count(screen, '\n')), height);
    }
}

// The name of a path planner is the mission's affair, so that nobody has to know it to ask for a way.
TEST(Reach, ThePathPlannerIsTheRobotsOwnOrTheOnlyOne) {
  lib::MissionView view;
  EXPECT_EQ(cli::path_planner_of(view, {}), "pathplan_svc") << "nothing is known";
  view.take(known("scout", {}));
  EXPECT_EQ(cli::path_planner_of(view, {}), "scout.path");
  view.take(known("primary", {}));
  cli::ReachArguments asked;
  asked.robot = "primary";
  EXPECT_EQ(cli::path_planner_of(view, asked), "primary.path");
  asked.service = "mine";
  EXPECT_EQ(cli::path_planner_of(view, asked), "mine");
  EXPECT_THAT([&] { cli::path_planner_of(view, {}); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  "there are several path planners; name one with --service: primary.path, scout.path"));
}

}  // namespace
}  // namespace roci::console
