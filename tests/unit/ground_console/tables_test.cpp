// The tables of roci: the plan, goal kinds, runs, one row for each timeline.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/plan_values.hpp"
#include "ground_console/cli/runs.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/cli/timelines.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

namespace fs = std::filesystem;
using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

TEST(Table, ColumnsAreAsWideAsTheirWidestCell) {
  EXPECT_EQ(cli::table_text({{"A", "B"}, {"größe", "x"}, {"a\nb", ""}}),
            "A      B\n"
            "größe  x\n"
            "a?b\n");
}

TEST(PlanTable, SaysWhatWhenAndForWhichGoals) {
  lib::MissionView view = flying_mission();
  v1::Plan plan;
  plan.version(3);
  plan.origin_us(100'000'000);
  plan.point_count(5);
  v1::PlanActivity image, drive;
  v1::Property to, image_name;
  to.name("to");
  to.value("place-ridge");
  image_name.name("1");
  image_name.value("image-ridge");
  drive.id("p3.1-drive");
  drive.name("drive");
  drive.arguments({to});
  drive.start_point(1);
  drive.end_point(2);
  drive.duration_lower_us(190'000'000);
  drive.duration_upper_us(190'000'000);
  drive.goals_served({"ground/ridge"});
  image.id("p3.2-take-image");
  image.name("take-image");
  image.arguments({image_name});
  image.start_point(3);
  image.end_point(4);
  image.duration_lower_us(40'000'000);
  image.duration_upper_us(40'000'000);
  v1::TemporalConstraint order;
  order.from_point(2);
  order.to_point(3);
  order.lower_us(1'000'000);
  order.upper_us(-1);
  plan.constraints({order});
  plan.activities({image, drive});  // in no order
  view.take(plan);
  view.take(step("p3.1-drive", v1::ACTIVITY_SUCCEEDED, 3, 100, 100, 290));
  v1::StepStatus waiting = step("p3.2-take-image", v1::ACTIVITY_WAITING, 4, 295, -1, -1);
  waiting.started_us(-1);
  waiting.ended_us(-1);
  waiting.latest_start_us(400'000'000);
  view.take(waiting);
  EXPECT_EQ(cli::plan_table(view),
            "plan 3, from 00:01:40, now 00:05:00\n"
            "\n"
            "ACTIVITY         WHAT        ARGUMENTS       STATE      PLANNED   TAKES  WINDOW             "
            "EXECUTED           GOALS\n"
            "p3.1-drive       drive       to=place-ridge  succeeded  00:01:40  190 s                     "
            "00:01:40–00:04:50  "
            "ground/ridge\n"
            "p3.2-take-image  take-image  image-ridge     waiting    00:04:51  40 s   00:04:55–00:06:40\n");
  EXPECT_EQ(cli::plan_table(lib::MissionView()), "no plan yet\n");
}

// A drive and an image; the owner of the drive's values had map 1 when they were asked for.
lib::MissionView view_with_values() {
  lib::MissionView view = flying_mission();
  v1::Plan plan;
  plan.version(3);
  plan.origin_us(100'000'000);
  plan.point_count(5);
  const auto property = [](const char* name, const char* value) {
    v1::Property out;
    out.name(name);
    out.value(value);
    return out;
  };
  const auto activity = [&](const char* id, const char* name, std::vector<v1::Property> objects,
                            std::vector<v1::Property> words) {
    v1::PlanActivity out;
    out.id(id);
    out.name(name);
    out.arguments(std::move(objects));
    v1::PlanCommand command;
    command.arguments(std::move(words));
    out.commands({command});
    out.start_point(std::string(name) == "drive" ? 1 : 3);
    out.end_point(out.start_point() + 1);
    out.duration_lower_us(190'000'000);
    out.duration_upper_us(190'000'000);
    return out;
  };
  plan.activities({activity("p3.1-drive", "drive", {property("1", "here"), property("2", "place-ridge")},
                            {property("to", "place-ridge")}),
                   activity("p3.2-take-image", "take-image", {property("1", "image-ridge")},
                            {property("image", "image-ridge")})});
  const auto value = [](std::vector<std::string> arguments, double number) {
    v1::FunctionValueUse out;
    out.function("traverse_time");
    out.arguments(std::move(arguments));
    out.number(number);
    out.owner("pathplan_svc");
    out.model_version(1);
    out.computed_us(90'000'000);
    return out;
  };
  plan.function_values({value({"here", "place-ridge"}, 190), value({"place-ridge", "here"}, 180)});
  view.take(plan);
  return view;
}

v1::FunctionOffer offer_of_map(std::uint64_t version) {
  v1::FunctionOffer out;
  out.header(sent("pathplan_svc", version, 200));
  out.module_name("pathplan");
  out.owner("pathplan_svc");
  out.model_version(version);
  v1::FunctionSignature time;
  time.name("traverse_time");
  time.unit("s");
  out.functions({time});
  return out;
}

TEST(PlanValues, AreThoseOfTheActivityWithOwnerMapAndAge) {
  lib::MissionView view = view_with_values();
  view.take(offer_of_map(1));
  EXPECT_EQ(cli::values_text(view, cli::activities_named(view, "p3.1-drive")),
            "p3.1-drive (drive here place-ridge)\n"
            "FUNCTION       OF                VALUE  ACCURACY  SAID BY       MODEL  COMPUTED  AGE\n"
            "traverse_time  here place-ridge  190 s  exact     pathplan_svc  1      00:01:30  00:03:30\n");
  EXPECT_THAT(cli::values_text(view, cli::activities_named(view, "take-image")),
              HasSubstr("stands on no value of an external function"));
  EXPECT_THAT(cli::activities_named(view, "nothing"), IsEmpty());
  EXPECT_THAT(cli::plan_table(view), Not(HasSubstr("*")));
  EXPECT_THAT(cli::plan_table(view), HasSubstr("to=place-ridge"))
      << "the arguments stay those of the command";
}

TEST(PlanValues, OfAnOlderMapMarkWhatHasNotBegun) {
  lib::MissionView view = view_with_values();
  view.take(offer_of_map(1));
  view.take(offer_of_map(4));
  EXPECT_THAT(cli::values_text(view, cli::activities_named(view, "drive")), HasSubstr("1, now 4"));
  EXPECT_EQ(cli::values_json(view, view.plan()->activities()[0])[0]["model_version_now"], 4);
  EXPECT_THAT(cli::plan_table(view), HasSubstr("waiting *"));
  EXPECT_THAT(
      cli::plan_table(view),
      HasSubstr("\n\n* stands on values of version 1 of pathplan_svc's model, which has version 4 now; "
                "roci plan --why p3.1-drive shows them\n"));
  view.take(step("p3.1-drive", v1::ACTIVITY_RUNNING, 3, 100, 100, -1));
  EXPECT_THAT(cli::plan_table(view), Not(HasSubstr("*"))) << "it is under way";
}

TEST(MissionWords, OfPlanetaryHaveHelpAndExampleForEachGoalKind) {
  const cli::MissionWords words = cli::read_mission_words(ROCI_SOURCE_DIR "/missions/planetary");
  ASSERT_THAT(words.goal_kinds, SizeIs(3));
  for (const cli::GoalKindWords& kind : words.goal_kinds) {
    EXPECT_THAT(kind.help, Not(IsEmpty()));
    EXPECT_THAT(cli::example_of(kind), Not(HasSubstr("NUMBER")));
  }
  EXPECT_EQ(words.unit_of("rover.battery"), "J");
  EXPECT_EQ(words.unit_of("rover.arm.q3"), "rad");
  EXPECT_EQ(words.unit_of("rover.nav"), "");
  EXPECT_THAT(cli::goal_kinds_text(words),
              HasSubstr("photo: take an image at a place and send it in a communication window\n"
                        "  x  number\n"
                        "  y  number\n"
                        "  --opens, --closes  its window, in mission time\n"
                        "  e.g. roci goal add NAME photo x=110 y=60\n"));
  EXPECT_THAT(cli::goal_kinds_text(words), HasSubstr("  y  number\n  e.g. roci goal add NAME pick_sample"))
      << "it knows no window";
  EXPECT_EQ(cli::goal_kinds_json(words)[0]["arguments"]["x"], "number");
  EXPECT_EQ(cli::goal_kinds_json(words)[0]["window"], true);
}

TEST(Timelines, StandInTheTableOnceEachWithTheirUnit) {
  cli::MissionWords words;
  words.units["rover.battery"] = "J";
  using temporal::ProjectionKind;
  const cli::Timelines timelines{
      {"rover.battery",
       {{temporal::seconds(10), 900.0, ProjectionKind::executed, ""},
        {temporal::seconds(20), -100.0, ProjectionKind::planned, "a"},
        {temporal::seconds(30), -150.0, ProjectionKind::planned, "b"},
        {temporal::seconds(40), 750.0, ProjectionKind::projected, "b"}}},
      {"rover.nav",
       {{temporal::seconds(5), temporal::state("idle-at", {"here"}), ProjectionKind::executed, ""}}}};
  EXPECT_EQ(cli::timelines_table(timelines, words),
            "TIMELINE       NOW            SINCE     PLANNED LAST      PROJECTED LAST   UNIT\n"
            "rover.battery  900            00:00:10  -150 at 00:00:30  750 at 00:00:40  J\n"
            "rover.nav      idle-at(here)  00:00:05\n");
}

class Runs : public ::testing::Test {
 protected:
  Runs() { fs::create_directories(folder_); }
  ~Runs() override { fs::remove_all(folder_); }
  fs::path made(const std::string& name, const std::string& summary) {
    fs::create_directories(folder_ / name);
    if (!summary.empty()) std::ofstream(folder_ / name / "summary.json") << summary;
    return folder_ / name;
  }
  fs::path folder_ = fs::temp_directory_path() / ("roci_runs_" + std::to_string(::getpid()));
};

TEST_F(Runs, AreListedNewestFirstAndPrunedButForThoseThatRun) {
  const fs::path oldest = made("20260101T000000Z-planetary-nominal-1", "");
  made(
      "20260102T000000Z-planetary-nominal-2",
      R"({"mission": "/m/planetary", "scenario": "nominal", "result": "achieved", "goals": {"achieved": 3, "dropped": 0}, "sim_s": 60})");
  made("20260103T000000Z-planetary-nominal-3", "");
  made("my-own-notes", "");
  const auto runs = cli::past_runs(folder_, {oldest});
  ASSERT_THAT(runs, SizeIs(3));
  EXPECT_EQ(runs[0].result, "no summary");
  EXPECT_EQ(runs[1].result, "achieved");
  EXPECT_EQ(runs[1].goals, "3 achieved");
  EXPECT_EQ(runs[2].result, "running");
  EXPECT_THAT(cli::runs_text(runs),
              HasSubstr("20260102T000000Z-planetary-nominal-2  planetary  nominal   achieved    3 "
                        "achieved  00:01:00"));
  EXPECT_EQ(cli::runs_json(runs)[1]["result"], "achieved");
  EXPECT_THAT(cli::prune(runs, 1), SizeIs(1));
  EXPECT_TRUE(fs::exists(oldest)) << "it runs";
  EXPECT_FALSE(fs::exists(folder_ / "20260102T000000Z-planetary-nominal-2"));
  EXPECT_TRUE(fs::exists(folder_ / "my-own-notes"));
}

}  // namespace
}  // namespace roci::console
