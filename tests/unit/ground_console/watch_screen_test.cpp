// The screen of `roci watch`, to the character.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "ground_console/cli/watch/panels.hpp"
#include "ground_console/cli/watch/screen.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using ::testing::AllOf;
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

const std::string kFrame =
    R"(planetary   00:05:00   executing   plan 2, 1 replans                                                               q ends the view

Goals                                                                                            Way  ├──────────┤ 20 m   ▲ robot
A ✘ far               photo       hard          rejected, until 00:15:00, outside the map                        ▲
B ◔ ridge             photo       hard          planned, until 00:15:00, in plan 2

                                                                                                              ·
                                                                                                      ×
                                                                                                            ·


                                                                                                 ·  · ·  ·

Robot  camera imaging   nav idle-at

Plan 2                              00:01:40                                                                              00:05:35
    windows                                                                ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
  ✔ drive place-ridge               ████████████████████████████████████████████████████████████████████████████   │
  ▶ take-image image-ridge                                                                                       ███░░░░░░░░░░░░░░

Events
  00:00:10  exec_svc      goal ground/ridge accepted
  00:01:30  exec_svc      plan 1 is broken









)";

TEST(WatchScreen, ShowsAMissionInFlight) {
  EXPECT_EQ(cli::watch::watch_screen(flying_mission(), 130, 32).plain(), kFrame);
}

TEST(WatchScreen, DrawsTheNumbersOfThePlanAsCurves) {
  const std::vector<cli::watch::Level> levels{{"(battery)", {{200'000'000, -500}, {335'000'000, -2000}}, 0},
                                              {"(memory)", {{335'000'000, 4}}, 0}};
  cli::MissionWords words;
  words.units["(battery)"] = "J";
  cli::watch::Canvas canvas(36 + 24, 3);
  cli::watch::draw_levels(flying_mission(), levels, words, {0, 0, 60, 3}, canvas);
  EXPECT_THAT(lines_of(canvas.plain()),
              ::testing::ElementsAre("Levels, now → at the end of the plan",
                                     "    (battery) -500 J → -2 kJ        █████████▆▆▆▆▆▆▆▆▆▆▆▆▆▆▁",
                                     "    (memory) 0 → 4                  ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁█"));
}

TEST(WatchScreen, TellsAmountsInTheirUnits) {
  EXPECT_EQ(cli::amount_text(754'702, "J"), "755 kJ");
  EXPECT_EQ(cli::amount_text(999.6, "W"), "1 kW");
  EXPECT_EQ(cli::amount_text(-1'250'000, "B"), "-1.25 MB");
  EXPECT_EQ(cli::amount_text(0.25, "m"), "0.25 m");
  EXPECT_EQ(cli::amount_text(12, ""), "12");
}

TEST(WatchScreen, LeavesCurvesOutThatDoNotFit) {
  cli::watch::Canvas canvas(60, 3);
  cli::watch::draw_levels(flying_mission(), {{"(battery)", {{0, 1}}, 0}}, {}, {0, 0, 60, 1}, canvas);
  EXPECT_THAT(canvas.plain(), Not(HasSubstr("battery")));
}

TEST(WatchScreen, LeavesTheMapOutWhereItDoesNotFit) {
  EXPECT_THAT(cli::watch::watch_screen(flying_mission(), 130, 32).plain(), HasSubstr("▲"));
  EXPECT_THAT(cli::watch::watch_screen(flying_mission(), 70, 26).plain(), Not(HasSubstr("▲")));
}

// At 80 columns goals lose their kind and class, and the map stands beside them.
TEST(WatchScreen, HasAMapAt80ColumnsToo) {
  const auto lines = lines_of(cli::watch::watch_screen(flying_mission(), 80, 26).plain());
  ASSERT_GE(lines.size(), 5U);
  EXPECT_THAT(lines[2], AllOf(HasSubstr("Goals"), HasSubstr("Way")));
  EXPECT_THAT(lines[3], HasSubstr("A ✘ far          rejected, until 00:15:00"));
  EXPECT_THAT(cli::watch::watch_screen(flying_mission(), 80, 26).plain(), HasSubstr("▲"));
}

TEST(WatchScreen, WaitsForAMission) {
  EXPECT_EQ(lines_of(cli::watch::watch_screen(lib::MissionView(), 80, 24).plain()).at(0),
            "waiting for exec_svc                                             q ends the view");
}

TEST(WatchScreen, NeverLeavesTheTerminal) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    lib::MissionView view = flying_mission();
    for (std::uint64_t extra = random() % 40; extra > 0; --extra) {
      view.take(
          goal_status("goal" + std::to_string(extra), v1::GOAL_PENDING, 1, std::string(random() % 200, 'x')));
      view.take(event("größe " + std::string(random() % 200, 'y'), 1));
    }
    const std::size_t width = 1 + random() % 150;
    const std::size_t height = 1 + random() % 60;
    const auto lines = lines_of(cli::watch::watch_screen(view, width, height).plain());
    EXPECT_LE(lines.size(), height);
    for (const std::string& line : lines) EXPECT_LE(columns_of(line), width);
  }
}

TEST(WatchScreen, TakesNoControlCharactersFromOutside) {
  lib::MissionView view = flying_mission();
  view.take(goal_status("evil", v1::GOAL_REJECTED, 9, "kind '\x1b[2J\nno\x7f\xc2\x9b\xff'"));
  view.take(event("a\rb\x1b]0;c\a", 5));
  const std::string screen = cli::watch::watch_screen(view, 200, 40).plain();
  EXPECT_THAT(screen, HasSubstr("'?[2J?no?"
                                "?"
                                "?'"));
  EXPECT_TRUE(
      std::ranges::none_of(screen, [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }));
}

TEST(WatchScreen, ColoursChangeNothingElse) {
  const cli::watch::Canvas canvas = cli::watch::watch_screen(flying_mission(), 130, 32);
  std::string bare;
  const std::string coloured = canvas.coloured();
  for (std::size_t i = 0; i < coloured.size(); ++i) {
    if (coloured[i] == '\x1b')
      i = coloured.find('m', i);
    else
      bare += coloured[i];
  }
  EXPECT_NE(coloured, bare);
  EXPECT_EQ(bare, canvas.plain());
}

}  // namespace
}  // namespace roci::console
