// A run as one picture: timelines are read from its trace, each robot's map from its folder, and all is drawn once.
#include "ground_console/cli/map/run_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "ground_console/cli/map/run_folder.hpp"

namespace roci::console::cli::map {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

const char* kTwoRovers =
    "roci-trace 1 scenario=s seed=1 lines=trace\n"
    "0 observation scout.locomotion at(w0) sampled 0\n"
    "0 observation scout.x 5 sampled 0\n"
    "0 observation scout.y 15 sampled 0\n"
    "0 observation primary.x 4 sampled 0\n"
    "0 observation primary.y 15 sampled 0\n"
    "0 observation navigation team_cycle(w0, w1) sampled 0\n"
    "10000000 plan m 1 origin 15000000; p1.1-scout [1,2] to=w1; 0-1 [0,-1]\n"
    "15000000 observation scout.locomotion scouting(w0, w1) sampled 15000000\n"
    "15000000 observation scout.x 8 sampled 15000000\n"
    "15000000 observation scout.y 15 sampled 15000000\n"
    "15000000 ack p1.1-scout(w0, w1) 1 stage=0 scout.locomotion  \n"
    "20000000 ack p1.1-scout(w0, w1) 1 stage=0 scout.locomotion repairing drive: no-go\n"
    "30000000 observation scout.locomotion scouting(w0, w1) sampled 30000000\n"
    "60000000 ack p1.1-scout(w0, w1) 1 stage=2 scout.locomotion done \n"
    "60000000 observation scout.locomotion at(w1) sampled 60000000\n"
    "60000000 observation ground.window true sampled 60000000\n"
    "70000000 observation primary.battery 900 sampled 70000000\n";

Course course() {
  std::istringstream trace(kTwoRovers + std::string("this is no line\n"));
  return course_of(trace);
}

std::string text_of(const Row& row) {
  std::string out = row.timeline + ":";
  for (const Held& held : row.held)
    out += " " + held.value + " " + std::to_string(held.from_us / 1'000'000) + "-" +
           std::to_string(held.to_us / 1'000'000) + (held.planned ? " planned" : "");
  for (const std::int64_t at : row.repairs_us) out += " repair " + std::to_string(at / 1'000'000);
  return out;
}

std::vector<std::string> rows_of(const Course& course) {
  std::vector<std::string> out;
  for (const Row& row : course.rows) out.push_back(text_of(row));
  return out;
}

TEST(Course, HasStatesPlansAndRepairsOfATrace) {
  EXPECT_THAT(rows_of(course()),
              ElementsAre("scout.locomotion: at(w0) 0-15 scouting(w0, w1) 15-60 at(w1) 60-70 repair 20",
                          "navigation: team_cycle(w0, w1) 0-70", "ground.window: true 60-70"));
  EXPECT_THAT(course().plans, ElementsAre(std::pair<std::int64_t, std::string>{15'000'000, "1"}));
  EXPECT_EQ(course().end_us, 70'000'000);
}

// A cycle of a longer way on one timeline, then a state that stays; the drive is commanded, and its owner tells of it.
TEST(Course, HasTheStatesAboveTheCommands) {
  std::istringstream trace(
      "0 step p1.1-navigation.team(w0, w9) 0 [0,-1] \n"
      "10 step p1.1-navigation.team(w0, w9) 2 [10,10] \n"
      "20 step p1.2-navigation.cycle(w0, w1) 2 [20,20] \n"
      "20 command p1.3-wheels.going(w0, w1) 1 action=0 rover wheels Go to=w1\n"
      "20 step p1.3-wheels.going(w0, w1) 2 [20,20] \n"
      "20 step p1.5-take-image(2.5) 2 [20,20] \n"
      "30 step p1.3-wheels.going(w0, w1) 3 [20,20] \n"
      "30 step p1.2-navigation.cycle(w0, w1) 3 [20,20] \n"
      "40 step p1.1-navigation.team(w0, w9) 3 [10,10] \n"
      "50 step p1.4-mission.traversed(w9) 2 [50,50] \n"
      "50 step p1.4-mission.traversed(w9) 3 [50,50] \n"
      "90 observation rover.nav idle sampled 90\n");
  const Course out = course_of(trace);
  ASSERT_EQ(out.rows.size(), 3U);
  const auto text = [](const Row& row) {
    std::string all = row.timeline;
    for (const Held& held : row.held)
      all += " " + held.value + " " + std::to_string(held.from_us) + "-" + std::to_string(held.to_us);
    return all;
  };
  EXPECT_EQ(text(out.rows[0]), "navigation team(w0, w9) 10-20 cycle(w0, w1) 20-30 team(w0, w9) 30-40");
  EXPECT_EQ(text(out.rows[1]), "mission traversed(w9) 50-90") << "it was come to, and nothing has changed it";
  EXPECT_EQ(out.rows[2].timeline, "rover.nav");
}

TEST(Course, HasRowsOfTheTeamFirstThenByRobotAndWhatIsToCome) {
  Course out = course();
  add_planned("primary.locomotion", {{80'000'000, "following(w0, w1)"}}, 90'000'000, out);
  add_planned("scout.locomotion", {{80'000'000, "scouting(w1, w2)"}, {85'000'000, "at(w2)"}}, 90'000'000,
              out);
  add_planned("scout.nav", {}, 90'000'000, out);
  sort_by_robot({"primary", "scout"}, out);
  EXPECT_THAT(
      rows_of(out),
      ElementsAre("navigation: team_cycle(w0, w1) 0-70", "ground.window: true 60-70",
                  "primary.locomotion: following(w0, w1) 80-90 planned",
                  "scout.locomotion: at(w0) 0-15 scouting(w0, w1) 15-60 at(w1) 60-70 at(w1) 70-80 planned "
                  "scouting(w1, w2) 80-85 planned at(w2) 85-90 planned repair 20"));
}

TEST(Course, JoinsWhatAFamilyOfTimelinesSaysOnce) {
  std::istringstream trace(
      "0 observation p.nav idle sampled 0\n1000000 observation p.way.b.c open sampled 1\n"
      "2000000 observation p.way.c.d shut sampled 2\n2000000 observation p.arm.a up sampled 2\n"
      "3000000 observation p.way.d.e open sampled 3\n4000000 observation p.arm.b up sampled 4\n");
  Course out = course_of(trace);
  join_families(out);
  EXPECT_THAT(rows_of(out), ElementsAre("p.nav: idle 0-4", "p.way.*: b.c open 1-2 c.d shut 2-3 d.e open 3-4",
                                        "p.arm.a: up 2-4", "p.arm.b: up 4-4"));
}

TEST(Course, OfAnythingElseIsShortOrEmpty) {
  std::string many =
      "0 plan\n-5 observation a b sampled 0\n1 observation\n1 ack x stage=0 \n2 observation a b\n";
  for (std::size_t i = 0; i < 2 * kRows; ++i)
    many += "3 observation t" + std::to_string(i) + " on sampled 3\n";
  for (std::size_t i = 0; i < 2 * kChanges; ++i)
    many += std::to_string(i + 4) + " observation t0 s" + std::to_string(i) + " sampled 3\n";
  std::istringstream trace(many);
  const Course out = course_of(trace);
  EXPECT_THAT(out.rows, SizeIs(kRows));
  for (const Row& row : out.rows) EXPECT_LE(row.held.size(), kChanges);
}

class RunFolder : public testing::Test {
 protected:
  RunFolder() {
    fs::create_directories(folder_);
    write("scout.path.hazards",
          R"([{"found_by": "scout", "id": "soil-1", "kind": "soil", "x_m": 11, "y_m": 15, "radius_m": 1.25},
              {"found_by": "scout", "id": "rock-1", "kind": "rock", "x_m": 14, "y_m": 17, "radius_m": 0.5}])");
    write(
        "primary.path.hazards",
        R"([{"found_by": "scout", "id": "soil-1", "kind": "soil", "x_m": 11, "y_m": 15, "radius_m": 1.25}])");
    write("broken.hazards", "[{\"x_m\": ");
  }
  ~RunFolder() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  const fs::path folder_ =
      fs::temp_directory_path() / ("roci_run_picture_" + std::to_string(::getpid()) + "_" +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

const char* kMission = ROCI_SOURCE_DIR "/missions/faster";

TEST_F(RunFolder, HasTheMapOfEachRobot) {
  const auto owners = map_owners(mission::load_service_list(kMission));
  EXPECT_EQ(owners,
            (std::map<std::string, std::string>{{"primary.path", "primary"}, {"scout.path", "scout"}}));
  MissionMap map = read_mission_map(kMission);
  add_hazards(folder_, owners, map);
  EXPECT_THAT(map.known["primary"], SizeIs(1));
  ASSERT_THAT(map.known["scout"], SizeIs(2));
  EXPECT_EQ(map.known["scout"][0].kind, "soil");
  EXPECT_EQ(map.known["scout"][0].found_by, "scout");
  EXPECT_EQ(map.known["scout"][0].disc, (Circle{{11, 15}, 1.25}));
  EXPECT_THAT(map.hazards, SizeIs(2)) << "what both know stands once on the map of all";
  EXPECT_TRUE(map_owners(mission::load_service_list(ROCI_SOURCE_DIR "/missions/planetary")).empty())
      << "one robot has the map of all";
}

RunPicture picture() {
  RunPicture out{"faster", "scenario trial", {"primary", "scout"}, read_mission_map(kMission), course()};
  out.map->known["primary"] = {{{{11, 15}, 1.25}, "soil", "scout", "soil-1"}};
  out.map->known["scout"] = {{{{11, 15}, 1.25}, "soil", "scout", "soil-1"},
                             {{{14, 17}, 0.5}, "rock", "scout", "rock-1"}};
  out.map->driven["primary"] = {{4, 15}, {6, 15}};
  out.map->driven["scout"] = {{5, 15}, {9.5, 14.6}};
  sort_by_robot(out.robots, out.course);
  return out;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t out = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++out;
  return out;
}

TEST_F(RunFolder, IsDrawnWithAPanelForEachRobotAndARowForEachTimeline) {
  const std::string svg = to_svg(picture());
  EXPECT_THAT(svg, AllOf(HasSubstr("What primary knows: 1 obstacle beyond"),
                         HasSubstr("What scout knows: 2 obstacles beyond"),
                         HasSubstr("soil soil-1 found by scout at 11.00, 15.00 m, radius 1.25 m"),
                         HasSubstr("scout.locomotion: scouting(w0, w1), 00:00:15 to 00:01:00"),
                         HasSubstr("a repair begins at 00:00:20"), HasSubstr(">plan 1<")));
  EXPECT_EQ(count(svg, "data:image/png;base64,iVBORw0KGgo"), 2U) << "the ground in each panel";
  EXPECT_EQ(count(svg, "soil of scout"), 2U);
  EXPECT_EQ(count(svg, "rock of scout"), 1U) << "the primary has not heard of it";
  EXPECT_EQ(count(svg, "<g"), count(svg, "</g>"));
}

// Names of places stand above the ways, and beside one another where places are close.
TEST_F(RunFolder, NamesOfPlacesCanBeReadWhereWaysAndPlacesMeet) {
  RunPicture out = picture();
  out.robots.clear();
  out.map->known.clear();
  out.map->places = {{"near", {10, 15}}, {"nearer", {10.05, 15}}, {"nearest", {10.1, 15}}};
  out.map->driven["scout"] = {{5, 15}, {15, 15}};
  const std::string svg = to_svg(out);
  const std::size_t names = svg.find(">near<");
  ASSERT_NE(names, std::string::npos);
  EXPECT_GT(names, svg.rfind("stroke-width=\"3\""));
  std::set<std::string> anchors;
  for (const char* name : {">near<", ">nearer<", ">nearest<"}) {
    const std::size_t end = svg.find(name), begin = svg.rfind("<text", end);
    const std::size_t anchor = svg.find("text-anchor=\"", begin);
    anchors.insert(anchor < end ? svg.substr(anchor + 13, svg.find('"', anchor + 13) - anchor - 13)
                                : "start");
  }
  EXPECT_THAT(anchors, testing::UnorderedElementsAre("middle", "start", "end"));
}

TEST_F(RunFolder, OfAMissionWithoutGroundHasTimelinesAlone) {
  RunPicture bare{"<convoy> & \"co\"", "", {}, std::nullopt, course()};
  const std::string svg = to_svg(bare);
  EXPECT_THAT(svg, HasSubstr("&lt;convoy&gt; &amp; &quot;co&quot;"));
  EXPECT_THAT(svg, Not(HasSubstr("<image")));
  EXPECT_THAT(to_svg({"nothing"}), Not(HasSubstr("Timelines")));
  bare.map = read_mission_map(kMission);
  EXPECT_THAT(to_svg(bare), HasSubstr("The ground: 0 obstacles"));
}

TEST_F(RunFolder, IsWrittenByTheProgram) {
  write("run.txt", kTwoRovers);
  const auto map = [this](const std::string& arguments) {
    const std::string command = "'" ROCI_BINARY_DIR "/bin/roci' map " + arguments + " > '" +
                                (folder_ / "out").string() + "' 2> '" + (folder_ / "err").string() + "'";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const std::string run =
      " --mission '" + std::string(kMission) + "' --run '" + (folder_ / "run.txt").string() + "'";
  const std::string svg = (folder_ / "m.svg").string();
  ASSERT_EQ(map("--json --svg '" + svg + "'" + run), 0) << std::ifstream(folder_ / "err").rdbuf();
  const json told = json::parse(std::ifstream(folder_ / "out"));
  EXPECT_EQ(told["timelines"], 3);
  EXPECT_EQ(told["driven"]["scout"], 2);
  EXPECT_EQ(told["known"], (json{{"primary", 0}, {"scout", 0}}));
  std::ostringstream text;
  text << std::ifstream(svg).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("What scout knows"));
  EXPECT_EQ(map(run), 2) << "no file is named";
  EXPECT_EQ(map("--svg '" + (folder_ / "no/m.svg").string() + "'" + run), 1);
}

}  // namespace
}  // namespace roci::console::cli::map
