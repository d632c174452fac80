// Plans of several levels: what stands behind what, and what is folded where not all of it fits.
#include "ground_console/cli/levels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/watch/plan_rows.hpp"
#include "ground_console/cli/watch/screen.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

v1::PlanActivity part(const std::string& id, const std::string& parent) {
  v1::PlanActivity out;
  out.id(id);
  out.name(id);
  out.parent(parent);
  out.level(parent.empty() ? "abstract" : "primitive");
  return out;
}

std::vector<std::string> in_order(const std::vector<v1::PlanActivity>& activities) {
  std::vector<std::string> out;
  for (const auto& [activity, depth] :
       cli::in_levels(activities, [](const v1::PlanActivity* one) { return one->preferred_start_us(); }))
    out.push_back(std::string(depth, '>') + activity->id());
  return out;
}

TEST(InLevels, PartsStandBehindWhatTheyArePartsOf) {
  EXPECT_THAT(in_order({part("b1", "b"), part("a", ""), part("b", ""), part("a1", "a"), part("b2", "b"),
                        part("b11", "b1")}),
              ElementsAre("a", ">a1", "b", ">b1", ">>b11", ">b2"));
}

TEST(InLevels, NothingIsMissingWhateverParentsSay) {
  EXPECT_THAT(in_order({part("x", "y"), part("y", "x"), part("z", "z"), part("stray", "nobody"),
                        part("same", ""), part("same", "")}),
              ElementsAre("z", "stray", "same", "same", "x", "y"));
  std::vector<v1::PlanActivity> deep{part("0", "")};
  for (int i = 1; i < 100; ++i) deep.push_back(part(std::to_string(i), std::to_string(i - 1)));
  EXPECT_EQ(in_order(deep).size(), 100U);
}

// A traverse of `cycles` cycles of three steps each; the first `over` of them have ended,
// and the one after them runs its second step.
lib::MissionView traverse(int cycles, int over) {
  lib::MissionView view = flying_mission();
  v1::Plan plan;
  plan.header(sent("exec_svc", 2, 100));
  plan.version(3);
  std::vector<v1::PlanActivity> activities{part("traverse", "")};
  view.take(step("traverse", v1::ACTIVITY_RUNNING, 1, 0, 0, -1));
  for (int i = 0; i < cycles; ++i) {
    const std::string cycle = "cycle-" + std::to_string(i);
    activities.push_back(part(cycle, "traverse"));
    const double from = 30.0 * i;
    view.take(i < over    ? step(cycle, v1::ACTIVITY_SUCCEEDED, 1, from, from, from + 30)
              : i == over ? step(cycle, v1::ACTIVITY_RUNNING, 1, from, from, -1)
                          : step(cycle, v1::ACTIVITY_WAITING, 1, from, -1, -1));
    for (int j = 0; j < 3; ++j) {
      const std::string name = cycle + "." + std::to_string(j);
      activities.push_back(part(name, cycle));
      const double at = from + 10.0 * j;
      const bool done = i < over || (i == over && j == 0), runs = i == over && j == 1;
      view.take(done   ? step(name, v1::ACTIVITY_SUCCEEDED, 1, at, at, at + 10)
                : runs ? step(name, v1::ACTIVITY_RUNNING, 1, at, at, -1)
                       : step(name, v1::ACTIVITY_WAITING, 1, at, -1, -1));
    }
  }
  plan.activities(activities);
  view.take(plan);
  return view;
}

std::vector<std::string> shown(const lib::MissionView& view, std::size_t room) {
  std::vector<std::string> out;
  const cli::watch::PlanRows rows = cli::watch::plan_rows(view, room);
  for (const cli::watch::PlanRow& row : rows.rows)
    out.push_back(std::string(row.depth, '>') + row.activity->id() +
                  (row.folded > 0 ? " +" + std::to_string(row.folded) : ""));
  if (rows.gone + rows.more > 0)
    out.push_back(std::to_string(rows.gone) + " gone, " + std::to_string(rows.more) + " more");
  return out;
}

TEST(PlanRows, WhatIsOverIsFoldedFirstThenWhatIsFarAhead) {
  const lib::MissionView view = traverse(4, 2);
  EXPECT_EQ(shown(view, 17).size(), 17U);
  EXPECT_THAT(shown(view, 14),
              ElementsAre("traverse", ">cycle-0 +3", ">cycle-1", ">>cycle-1.0", ">>cycle-1.1", ">>cycle-1.2",
                          ">cycle-2", ">>cycle-2.0", ">>cycle-2.1", ">>cycle-2.2", ">cycle-3", ">>cycle-3.0",
                          ">>cycle-3.1", ">>cycle-3.2"));
}

TEST(PlanRows, OfWhatIsAheadTheLatestIsFoldedFirst) {
  const std::vector<std::string> rows = shown(traverse(4, 0), 14);
  ASSERT_EQ(rows.size(), 14U);
  EXPECT_EQ(rows.back(), ">cycle-3 +3");
  EXPECT_EQ(rows[5], ">cycle-1");
}

TEST(PlanRows, WhatRunsStaysTheLongest) {
  const lib::MissionView view = traverse(4, 2);
  EXPECT_THAT(shown(view, 8), ElementsAre("traverse", ">cycle-0 +3", ">cycle-1 +3", ">cycle-2", ">>cycle-2.0",
                                          ">>cycle-2.1", ">>cycle-2.2", ">cycle-3 +3"));
  EXPECT_THAT(shown(view, 5), ElementsAre("traverse", ">cycle-2", ">>cycle-2.1", ">>cycle-2.2", ">cycle-3 +3",
                                          "9 gone, 0 more"));
  EXPECT_THAT(shown(view, 3), ElementsAre("traverse", ">cycle-2", ">>cycle-2.1", "9 gone, 5 more"));
  EXPECT_THAT(shown(lib::MissionView(), 3), IsEmpty());
}

// An executive tells of what was skipped without times.
TEST(PlanRows, WhatWasSkippedIsOverAndMovesNoAxis) {
  lib::MissionView view = traverse(4, 2);
  v1::StepStatus skipped = step("cycle-0.2", v1::ACTIVITY_SKIPPED, 9, 0, -1, -1);
  skipped.earliest_start_us(INT64_MIN);
  skipped.latest_start_us(INT64_MAX);
  view.take(skipped);
  view.take(step("cycle-0.1", v1::ACTIVITY_SKIPPED, 9, 9000, -1, -1));
  EXPECT_EQ(shown(view, 8).at(1), ">cycle-0 +3");
  EXPECT_THAT(cli::watch::watch_screen(view, 120, 60).plain(), HasSubstr("00:00:00    "));
  EXPECT_THAT(cli::watch::watch_screen(view, 120, 60).plain(), Not(HasSubstr(":-")));
  EXPECT_THAT(cli::watch::watch_screen(view, 120, 60).plain(), Not(HasSubstr("02:30:00")));
}

TEST(PlanRows, KeepWithinTheirRoomAndCountTheRest) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    const int cycles = 1 + static_cast<int>(random() % 12);
    const lib::MissionView view = traverse(cycles, static_cast<int>(random() % (cycles + 1)));
    const std::size_t room = random() % 60;
    const cli::watch::PlanRows rows = cli::watch::plan_rows(view, room);
    EXPECT_LE(rows.rows.size(), room);
    std::size_t counted = rows.gone + rows.more;
    for (const cli::watch::PlanRow& row : rows.rows) counted += row.folded + 1;
    EXPECT_EQ(counted, view.plan()->activities().size());
  }
}

TEST(WatchScreen, ShowsTheLevelsOfAPlan) {
  EXPECT_THAT(cli::watch::watch_screen(traverse(3, 1), 100, 36).plain(), HasSubstr("cycle-2.2"))
      << "where few events are told the plan has their room";
  const std::string screen = cli::watch::watch_screen(traverse(3, 1), 100, 27).plain();
  const std::string plan =
      screen.substr(screen.find("Plan 3"), screen.find("Events") - screen.find("Plan 3"));
  EXPECT_EQ(
      plan,
      R"(Plan 3                                  00:00:00                                            00:05:00
    windows                                                                    ▁▁▁▁▁▁▁▁▁▁▁▁▁
  ▶ traverse                            ████████████████████████████████████████████████████████████
  ✔   cycle-0 +3                        ██████                                                     │
  ▶   cycle-1                                ███████████████████████████████████████████████████████
  ✔     cycle-1.0                            ███                                                   │
  ▶     cycle-1.1                              █████████████████████████████████████████████████████
        cycle-1.2                                ░                                                 │
      cycle-2 +3                                   ░                                               │

)");
}

TEST(PlanTable, HasLevelsWhereThePlanHas) {
  EXPECT_EQ(cli::plan_table(traverse(1, 0)),
            R"(plan 3, from 00:00:00, now 00:05:00

ACTIVITY       LEVEL      WHAT       ARGUMENTS  STATE      PLANNED  TAKES  WINDOW     EXECUTED           GOALS
traverse       abstract   traverse              running             0 s               00:00:00–
  cycle-0      primitive  cycle-0               running             0 s               00:00:00–
    cycle-0.0  primitive  cycle-0.0             succeeded           0 s               00:00:00–00:00:10
    cycle-0.1  primitive  cycle-0.1             running             0 s               00:00:10–
    cycle-0.2  primitive  cycle-0.2             waiting             0 s    00:00:20–
)");
  EXPECT_THAT(cli::plan_table(flying_mission()), Not(HasSubstr("LEVEL")));
}

TEST(Json, OfAPlanHasLevelAndParent) {
  const nlohmann::json plan = cli::plan_json(traverse(1, 0));
  EXPECT_EQ(plan["activities"][1]["parent"], "traverse");
  EXPECT_EQ(plan["activities"][1]["level"], "primitive");
}

}  // namespace
}  // namespace roci::console
