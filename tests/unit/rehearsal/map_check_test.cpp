// The map of a mission, what is placed on it, and how a goal that cannot be reached there is told.
#include "tests/unit/rehearsal/copied_mission.hpp"

namespace roci::rehearsal::check {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SlipOnTheMap : public ::testing::TestWithParam<Slip> {};

TEST_P(SlipOnTheMap, IsTheOneFinding) { expect_found(kPlanetary, GetParam()); }

// The site's files are read by the readers that fly; what the mission places must lie on the map.
INSTANTIATE_TEST_SUITE_P(
    Map, SlipOnTheMap,
    ::testing::Values(
        Slip{"mission.yaml", "site: site/site.yaml", "site: site/sight.yaml", "cannot be read",
             "check that the file exists", "FILE site/sight.yaml"},
        Slip{"site/site.yaml", "image: rocks.pgm", "image: rockes.pgm", "image 'rockes.pgm' is not there",
             "it is looked for beside this file"},
        Slip{"site/site.yaml", "resolution: 1.000", "resolution: 0", "must be positive", "metres per"},
        Slip{"site/site.yaml", "image: elevation.pgm", "image: small.pgm",
             "the elevation image has 3 x 2 pixels, the map 240 x 240", "the same cells"},
        Slip{"site/site.yaml", "image: elevation.pgm", "image: cut.pgm", "truncated: 57600 bytes",
             "generate or copy the file again", "FILE site/cut.pgm"},
        Slip{kMission, "objects:\n  - {name: here,",
             "objects:\n  - {name: base, type: location, properties: {x: 900, y: 3}}\n  - {name: here,",
             "object 'base' at (900, 3) lies outside the map", "from (0, 0) to (240, 240)",
             "  - {name: base"},
        Slip{kNominal, "{x: 110, y: 60}", "{x: 1100, y: 60}",
             "goal 'ridge' asks for place-ridge at (1100, 60), which lies outside the map",
             "from (0, 0) to (240, 240)"},
        Slip{kNominal, "  slip: 0.04", "  rocks: [{x: 60, y: -45, radius: 2}]\n  slip: 0.04",
             "the rock at (60, -45) lies outside the map", "the map reaches from"},
        Slip{kNominal, "stimuli:\n", "stimuli:\n  - {at_s: 5, hazard: {id: far, x: 600, y: 4, radius: 2}}\n",
             "the obstacle at (600, 4) lies outside the map", "the map reaches from", "BELOW"}));

// A goal that is to be given up may be anywhere.
TEST(MissionCheck, AGoalOutsideTheMapMayBeWhatAScenarioIsAbout) {
  const CopiedMission copy(kPlanetary);
  copy.edit(kNominal, "expect:\n",
            "  - {at_s: 20, goal: {id: moon, kind: photo, arguments: {x: 9999, y: 60}}}\nexpect:\n  - "
            "goal.dropped: moon\n");
  EXPECT_THAT(printed(check_mission(copy.folder())), IsEmpty());
}

// The finding names goal, arguments and who said what; the planner's words are kept apart.
TEST(MissionCheck, AGoalWithoutAPlanIsToldInTheWordsOfTheMission) {
  const CopiedMission copy(kPlanetary);
  const int line = copy.edit(kMission, "  photo:\n", "  photo:\n");
  copy.edit(kNominal, "{x: 110, y: 60}", "{x: 190, y: 60}");
  for (const char* other : {"arm_fault", "comm_lost", "too_many"})
    fs::remove(copy.folder() / "scenarios" / (std::string(other) + ".yaml"));
  const CheckReport report = check_mission(copy.folder());
  ASSERT_EQ(report.findings.size(), 1U) << ::testing::PrintToString(printed(report));
  const mission::Finding& finding = report.findings.all().front();
  EXPECT_EQ(finding.line, line + 1);
  EXPECT_THAT(finding.what,
              HasSubstr("no plan achieves a goal of kind 'photo' (goal 'ridge' of scenario 'nominal') "
                        "with x=190 y=60: place-ridge (x=190 y=60) is unreachable (says pathplan_svc, "));
  EXPECT_THAT(finding.what, HasSubstr("model 1)"));
  EXPECT_THAT(finding.what, ::testing::Not(HasSubstr("no sequence of actions reaches")));
  EXPECT_THAT(finding.remedy, HasSubstr("--why"));
  ASSERT_EQ(report.plans.unachieved.size(), 1U);
  EXPECT_EQ(report.plans.unachieved.front().verdict, "unsolvable");
  EXPECT_THAT(report.plans.unachieved.front().details, HasSubstr("(sent image-ridge)"));
}

}  // namespace
}  // namespace roci::rehearsal::check
