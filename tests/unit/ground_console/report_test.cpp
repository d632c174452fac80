// What roci prints: the screen of `roci watch` to the character, and JSON that parses whatever came down.
#include "ground_console/cli/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::size_t columns_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

const std::string kFrame = R"(planetary   00:05:00   executing   plan 2   replans 1

Goals
  ground/far               photo        hard           rejected  outside the map
  ground/ridge             photo        hard           planned   in plan 2

Plan 2                                      00:01:40                             00:05:35
  drive place-ridge              succeeded  ████████████████████████████████████ │       
  take-image image-ridge         running                                        ██▒▒▒▒▒▒▒

Robot  camera imaging   nav idle-at

Events
  00:00:10  exec_svc     goal ground/ridge accepted
  00:01:30  exec_svc     warning: plan 1 is broken
)";

TEST(WatchScreen, ShowsAMissionInFlight) { EXPECT_EQ(watch_screen(flying_mission(), 90, 30), kFrame); }

// 60 columns: bars at their shortest, lines cut.
TEST(WatchScreen, CutsWhatDoesNotFit) {
  const auto lines = lines_of(watch_screen(flying_mission(), 60, 12));
  ASSERT_LE(lines.size(), 12U);
  EXPECT_EQ(lines[3],
            std::string("  ground/far               photo        hard           rejected  o").substr(0, 60));
}

TEST(WatchScreen, WaitsForAMission) {
  EXPECT_EQ(lines_of(watch_screen(MissionView(), 80, 24)).at(0), "waiting for exec_svc   00:00:00");
}

TEST(WatchScreen, NeverLeavesTheTerminal) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    MissionView view = flying_mission();
    for (std::uint64_t extra = random() % 40; extra > 0; --extra) {
      view.take(
          goal_status("goal" + std::to_string(extra), v1::GOAL_PENDING, 1, std::string(random() % 200, 'x')));
      view.take(event("größe " + std::string(random() % 200, 'y'), 1));
    }
    const std::size_t width = 1 + random() % 150;
    const std::size_t height = 1 + random() % 60;
    const auto lines = lines_of(watch_screen(view, width, height));
    EXPECT_LE(lines.size(), height);
    for (const std::string& line : lines) EXPECT_LE(columns_of(line), width);
  }
}

TEST(WatchScreen, TakesNoControlCharactersFromOutside) {
  MissionView view = flying_mission();
  view.take(goal_status("evil", v1::GOAL_REJECTED, 9, "unknown goal kind '\x1b[2J\nnothing\x7f'"));
  view.take(event("a\rb\x1b]0;c\a", 5));
  const std::string screen = watch_screen(view, 200, 40);
  EXPECT_THAT(screen, HasSubstr("'?[2J?nothing?'"));
  EXPECT_TRUE(
      std::ranges::none_of(screen, [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }));
}

TEST(Json, OfTheStatusHasEveryPart) {
  MissionView view = flying_mission();
  v1::Heartbeat beat;
  beat.service("arm_svc");
  beat.state(v1::SERVICE_RUNNING);
  view.take(beat);
  const json status = json::parse(json_text(status_json(view)));
  EXPECT_EQ(status["mission"], "planetary");
  EXPECT_EQ(status["phase"], "executing");
  EXPECT_EQ(status["time_s"], 300);
  EXPECT_EQ(status["replans"], 1);
  ASSERT_EQ(status["goals"].size(), 2U);
  EXPECT_EQ(status["goals"][0]["id"], "far");
  EXPECT_EQ(status["goals"][0]["state"], "rejected");
  EXPECT_EQ(status["goals"][1]["class"], "hard");
  EXPECT_EQ(status["services"][0]["state"], "running");
  EXPECT_EQ(status["timelines"]["rover.nav"], "idle-at");
}

TEST(Json, OfThePlanHasItsActivitiesAndTheirStates) {
  const json plan = json::parse(json_text(plan_json(flying_mission())));
  EXPECT_EQ(plan["version"], 2);
  ASSERT_EQ(plan["activities"].size(), 2U);
  EXPECT_EQ(plan["activities"][0]["state"], "succeeded");
  EXPECT_EQ(plan["activities"][0]["ended_us"], 290'000'000);
  EXPECT_EQ(plan["activities"][1]["ended_us"], -1);
  EXPECT_EQ(json_text(plan_json(MissionView())), "null");
}

TEST(Json, ParsesWhateverBytesCameDown) {
  const v1::GoalStatus status = goal_status("\xff", v1::GOAL_REJECTED, 1, "unknown kind '\xc3\x28\"\n'");
  EXPECT_EQ(json::parse(json_text(to_json(status)))["state"], "rejected");
  EXPECT_EQ(json::parse(json_text(to_json(event("\xff", 1))))["severity"], "info");
  EXPECT_THAT(json_text(to_json(status)), Not(HasSubstr("\n")));
}

TEST(Lines, NameWhatMatters) {
  EXPECT_THAT(goal_line(goal_status("far", v1::GOAL_REJECTED, 1, "outside the map")),
              ::testing::ContainsRegex("ground/far +photo +hard +rejected +outside the map"));
  EXPECT_EQ(event_line(event("plan 1 is broken", 90, v1::SEVERITY_WARNING)),
            "00:01:30  exec_svc     warning: plan 1 is broken");
  EXPECT_THAT(status_text(flying_mission()), HasSubstr("planetary  00:05:00  executing, plan 2, 1 replans"));
}

}  // namespace
}  // namespace roci::console
