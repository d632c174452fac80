// A mission is copied and broken by one edit: the check finds it, at its place, with a remedy, and nothing else.
#include "tests/unit/rehearsal/copied_mission.hpp"

namespace roci::rehearsal::check {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(MissionCheck, PlanetaryIsSoundAndEachOfItsGoalKindsIsPlanned) {
  const CheckReport report = check_mission(kPlanetary);
  EXPECT_THAT(printed(report), IsEmpty());
  EXPECT_EQ(report.scenarios.size(), 8U);
  EXPECT_EQ(report.plans.planned.size(), 3U);
  EXPECT_THAT(report.plans.not_tried, IsEmpty());
}

TEST(MissionCheck, QuarryAndItsBeaconAreSoundAndWhatCannotBePlannedHereIsSaid) {
  const CheckReport report = check_mission(kQuarry);
  EXPECT_THAT(printed(report), IsEmpty());
  EXPECT_EQ(report.scenarios.size(), 2U);
  ASSERT_EQ(report.plans.not_tried.size(), 3U);
  EXPECT_EQ(report.plans.not_tried.front().why, "engine 'search' reads no PDDL");
}

// Also of those whose programs the build brings: stand-ins are there for them.
TEST(MissionCheck, TheSourcesOfTheTestsMissionsAreSound) {
  std::size_t missions = 0;
  for (const auto& entry : fs::directory_iterator(ROCI_SOURCE_DIR "/tests/missions")) {
    if (!fs::exists(entry.path() / "mission.yaml")) continue;
    ++missions;
    EXPECT_THAT(printed(check_mission(entry.path())), IsEmpty()) << entry.path();
  }
  EXPECT_GE(missions, 8U);
}

class PlanetarySlip : public ::testing::TestWithParam<Slip> {};

TEST_P(PlanetarySlip, IsTheOneFinding) { expect_found(kPlanetary, GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Names, PlanetarySlip,
    ::testing::Values(
        Slip{kMission, "owner: sim_svc\n    fallback: stop\n    states:\n      idle-pose",
             "owner: sim_scv\n    fallback: stop\n    states:\n      idle-pose", "no service 'sim_scv'",
             "did you mean 'sim_svc'?"},
        Slip{kMission, "- {name: arm_svc,", "- {name: arm_scv,", "there is no program 'arm_scv'",
             "did you mean 'arm_svc'?"},
        Slip{kMission, "drive: {owner: sim_svc", "drive: {owner: sim_scv", "no service 'sim_scv'",
             "did you mean 'sim_svc'?"},
        Slip{kMission, "{name: arm_svc, robot: rover}", "{name: arm_svc, robot: rovre}", "no robot 'rovre'",
             "did you mean 'rover'?"},
        Slip{kMission, "idle-at: {facts", "idle-ta: {facts", "component 'nav' is never in a state 'idle-ta'",
             "did you mean 'idle-at'?"},
        Slip{kMission, "      working: {active: true}\n", "", "can be in a state 'working'", "add it",
             "empty: {facts: [\"(gripper-empty)\"]}"},
        Slip{kMission, "held: {facts", "hled: {facts", "is never in a state 'hled'", "did you mean 'held'?"},
        Slip{kMission, "idle-at: {facts: [\"(at ?1)\"]}", "idle-at: {facts: [\"(at ?2)\"]}",
             "the state 'idle-at' has 1 arguments, and ?2", "name one"},
        Slip{kMission, "timeline: rover.camera\n", "timeline: rover.camra\n",
             "nobody tells of a timeline 'rover.camra'", "did you mean 'rover.camera'?"},
        Slip{kMission, "timeline: rover.battery}", "timeline: rover.batery}", "timeline 'rover.batery'",
             "did you mean 'rover.battery'?"},
        Slip{kMission, "y: {timeline: rover.y}", "y: {timeline: rovre.y}", "timeline 'rovre.y'",
             "did you mean 'rover.y'?"},
        Slip{kMission, "rover.sample.sample-{id}", "rover.smaple.sample-{id}",
             "timeline 'rover.smaple.sample-{id}'", "did you mean 'rover.sample.'?"},
        Slip{kMission, "- {name: nav, type: drive,", "- {name: nav, type: drive, planner: pathplan_scv,",
             "'nav' asks 'pathplan_scv' for its ways", "did you mean 'pathplan_svc'?"},
        Slip{kMission, "- {name: arm, type: arm,", "- {name: arm, type: arm, planner: arm_scv,",
             "'arm' asks 'arm_scv' for its motions", "did you mean 'arm_svc'?"},
        Slip{kMission, "engine: temporal_pddl", "engine: temporal_pdl",
             "no planner has an engine 'temporal_pdl'", "did you mean 'temporal_pddl'?"},
        Slip{kMission, "work: 4000", "work: 400000", "a call that spends it takes",
             "a longer reply_timeout_s"},
        Slip{kMission, "work: 4000", "work: -4000", "a budget cannot be -4000", "write a number from 0"},
        Slip{kMission, "(camera-idle)", "(camera-idel)", "no predicate 'camera-idel'",
             "did you mean 'camera-idle'?"},
        Slip{kMission, "transmit: {owner", "transmitt: {owner", "no action 'transmitt'",
             "did you mean 'transmit'?"},
        Slip{kMission, "type: image}", "type: imgae}", "no type 'imgae'", "did you mean 'image'?"}));

INSTANTIATE_TEST_SUITE_P(
    Windows, PlanetarySlip,
    ::testing::Values(Slip{kMission, "timeline: comm.window", "timeline: com.window",
                           "'radio' waits for a window 'comm.window'", "did you mean 'com.window'?",
                           "name: radio, type: radio"},
                      Slip{"scenarios/comm_lost.yaml", "timeline: comm.window", "timeline: comm.windwo",
                           "the mission has no window 'comm.windwo'", "did you mean 'comm.window'?"}));

INSTANTIATE_TEST_SUITE_P(
    Actions, PlanetarySlip,
    ::testing::Values(Slip{kMission, "x: \"?2.x\"", "x: \"?2.xx\"",
                           "no object of type location has a property 'xx'", "did you mean 'x'?"},
                      Slip{kMission, "properties: {x: \"{x}\", y: \"{y}\"}", "properties: {x: \"{x}\"}",
                           "object 'place-{id}' has no property 'y', which action 'drive'",
                           "add it under properties"},
                      Slip{kMission, "type: location, dynamic: true, properties: {x: {timeline: rover.x}, ",
                           "type: location, dynamic: true, properties: {",
                           "object 'here' has no property 'x'", "add it under properties"},
                      Slip{kMission, "to: \"?2\"}, lateness", "to: \"?3\"}, lateness",
                           "action 'move-arm' has 2 parameters, and ?3", "name one"},
                      Slip{kMission, "command: send", "command: sned", "'radio' has no command 'sned'",
                           "did you mean 'send'?"},
                      Slip{kMission, "command: image, arguments: {image:",
                           "command: image, arguments: {imgae:", "command 'image' needs an argument 'image'",
                           ""}));

INSTANTIATE_TEST_SUITE_P(
    GoalKinds, PlanetarySlip,
    ::testing::Values(Slip{kMission, "goal: [\"(sent image-{id})\"]", "goal: [\"(available image-{id})\"]",
                           "no state of a component or family stands for (available ...)",
                           "under 'achieved'"},
                      Slip{kMission, "goal: [\"(sent image-{id})\"]", "goal: [\"(snet image-{id})\"]",
                           "no predicate 'snet'", "did you mean 'sent'?"},
                      Slip{kMission, "image-{id} place-{id})\"]", "image-{id} place-{di})\"]",
                           "{di} stands here", "did you mean 'id'?"},
                      Slip{kMission, "goal_kind: photo", "goal_kind: phtoo", "no goal kind 'phtoo'",
                           "did you mean 'photo'?"},
                      Slip{"domain.pddl", "(:module pathplan", "(:module pathpaln",
                           "no service of the mission offers module 'pathpaln'", "did you mean 'pathplan'?"},
                      Slip{"domain.pddl", "(at end (sent ?i))", "(at end (have-image ?i))",
                           "no plan achieves a goal of kind 'photo' (goal 'ridge' of scenario 'nominal')",
                           "check", "    help: take an image"}));

INSTANTIATE_TEST_SUITE_P(
    Scenarios, PlanetarySlip,
    ::testing::Values(Slip{kNominal, "battery: 900000", "battery: 1900000",
                           "begin with 1900000 J, and holds 1000000 J", "lower it"},
                      Slip{kNominal, "world:\n", "wrold:\n", "unknown key 'wrold'", "did you mean 'world'?"},
                      Slip{kNominal, "goal.accepted: ridge", "goal.acepted: ridge", "an event 'goal.acepted'",
                           "did you mean 'goal.accepted'?"},
                      Slip{kNominal, "goal.accepted: ridge", "goal.accepted: rigde",
                           "the scenario sends no goal 'rigde'", "did you mean 'ridge'?"},
                      Slip{kNominal, "  - {at_s: 10, goal: {issuer: ground, id: soil",
                           "  - {at_s: 10, goal: {id: ridge, kind: photo, arguments: {x: 90, y: 60}}}\n"
                           "  - {at_s: 10, goal: {issuer: ground, id: soil",
                           "goal 'ridge' stands in line 10 already, for the same time", "give it another id"},
                      Slip{kNominal, "kind: photo", "kind: phtoo",
                           "goal 'ridge' will be rejected: unknown goal kind 'phtoo'",
                           "did you mean 'photo'?"},
                      Slip{kNominal, "{x: 110, y: 60}", "{x: 110, z: 60}", "argument 'y' is missing",
                           "a photo needs: x, y"},
                      Slip{kNominal, "x: 40, y: 40", "x: 40, y: 4000",
                           "the rover would start outside the map", "give x and y"},
                      Slip{kNominal, "start: {x: 40, y: 40,", "start: {x: 40,", "'y' is missing", "add it"},
                      Slip{"scenarios/arm_fault.yaml", "fault: {component: arm,", "fault: {component: amr,",
                           "unknown component 'amr'", "did you mean 'arm'?"}));

INSTANTIATE_TEST_SUITE_P(
    Clock, PlanetarySlip,
    ::testing::Values(
        Slip{kMission, "- {name: sim_svc, clock: master} ", "- {name: sim_svc} ",
             "no service has clock: master", "add it here"},
        Slip{kMission,
             "- {name: sim_svc, clock: master}                      # the world: every robot of it\n"
             "  - {name: exec_svc, robot: rover, standby: true}",
             "- {name: exec_svc, robot: rover, clock: master}\n  - {name: sim_svc}",
             "'exec_svc' simulates nothing", "to the service with the program sim_svc"}));

// A change of a goal can be meant.
TEST(MissionCheck, AGoalThatIsSentAgainLaterIsTold) {
  const CopiedMission copy(kPlanetary);
  const std::string again = "  - {at_s: 90, goal: {id: ridge, kind: photo, arguments: {x: 90, y: 60}}}\n";
  const int line = copy.edit(kNominal, "expect:\n", again + "expect:\n");
  const CheckReport report = check_mission(copy.folder());
  ASSERT_EQ(report.findings.size(), 1U) << ::testing::PrintToString(printed(report));
  const mission::Finding& told = report.findings.all().front();
  EXPECT_EQ(told.severity, mission::Severity::warning);
  EXPECT_EQ(told.line, line);
  EXPECT_THAT(told.what, HasSubstr("goal 'ridge' stands in line 10 "));
  EXPECT_EQ(report.plans.planned.size(), 3U) << "it can be flown";
}

TEST(MissionCheck, AGoalThatIsRecalledMayBeSentAgain) {
  const CopiedMission copy(kPlanetary);
  copy.edit(kNominal, "expect:\n",
            "  - {at_s: 50, recall: {id: ridge}}\n"
            "  - {at_s: 90, goal: {id: ridge, kind: photo, arguments: {x: 90, y: 60}}}\nexpect:\n");
  EXPECT_THAT(printed(check_mission(copy.folder())), IsEmpty());
}

class QuarrySlip : public ::testing::TestWithParam<Slip> {};

TEST_P(QuarrySlip, IsTheOneFinding) { expect_found(kQuarry, GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Data, QuarrySlip,
    ::testing::Values(Slip{"digger.yaml", "timeline: \"{robot}.boom\"", "timeline: \"{robot}.bom\"",
                           "nobody tells of a timeline 'digger.bom'", "did you mean 'digger.boom'?"},
                      Slip{"digger.yaml", "is: dug}", "is: dgu}", "'digger.boom' is never in a state 'dgu'",
                           "did you mean 'dug'?"},
                      Slip{"digger.yaml", "owner: beacon", "owner: becaon", "no service 'becaon'",
                           "did you mean 'beacon'?"},
                      Slip{kMission, "needs: {wheels: at-pit}", "needs: {wheels: at-pti}",
                           "'hauler.wheels' is never in a state 'at-pti'", "did you mean 'at-pit'?"},
                      Slip{"scenarios/boom_fault.yaml", "kind: haul, robot: hauler, importance: optional",
                           "kind: haul, robot: huler, importance: optional",
                           "no executive commands robot 'huler'", "hauler"}));

// The planner reads such a model with the first request alone: until then nobody would say what is wrong with it.
class PorterSlip : public ::testing::TestWithParam<Slip> {};

TEST_P(PorterSlip, IsTheOneFinding) { expect_found(ROCI_SOURCE_DIR "/tests/missions/porter", GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Models, PorterSlip,
    ::testing::Values(Slip{"porter.yaml", "needs: [during base.at(place)]", "needs: [during bsae.at(place)]",
                           "unknown component 'bsae'", "did you mean 'base'?"},
                      Slip{"porter.yaml", "where: [\"path(from, to)\"]", "where: [\"paht(from, to)\"]",
                           "'paht'", "did you mean 'path'?"},
                      Slip{kMission, "timeline: errand, is", "timeline: erand, is",
                           "nobody tells of a timeline 'erand'", "did you mean 'errand'?"}));

// A goal of a state that no timeline shows would be planned and carried out again and again.
TEST(MissionCheck, AGoalWhoseStateNobodySeesIsFound) {
  const CopiedMission copy(ROCI_SOURCE_DIR "/tests/missions/porter");
  for (const char* kind : {"idle: {kind: default", "fetching: {kind: complex, parameters: {crate: crate}",
                           "fetched: {kind: default, parameters: {crate: crate}"})
    copy.edit("porter.yaml", kind + std::string(", observed: {timeline: errand}"), kind);
  EXPECT_THAT(printed(check_mission(copy.folder())),
              ElementsAre(HasSubstr("nobody tells of a timeline 'errand'")));
}

TEST(MissionCheck, AllFindingsAreListedInTheOrderOfTheFiles) {
  const CopiedMission copy(kPlanetary);
  copy.edit(kMission, "fallback: stop", "fallback: sotp");
  copy.edit(kMission, "timeline: rover.battery}", "timeline: rover.batery}");
  copy.edit(kMission, "idle-at: {facts", "idle-ta: {facts");
  copy.edit(kNominal, "battery: 900000", "battery: 1900000");
  copy.edit("scenarios/too_many.yaml", "goal.dropped: rim", "goal.droped: rim");
  const CheckReport report = check_mission(copy.folder());
  const auto lines = printed(report);
  ASSERT_EQ(lines.size(), 5U) << ::testing::PrintToString(lines);
  EXPECT_THAT(lines[0], HasSubstr("'sotp'"));
  EXPECT_THAT(lines[1], HasSubstr("'idle-ta'"));
  EXPECT_THAT(lines[2], HasSubstr("'rover.batery'"));
  EXPECT_THAT(lines[3], HasSubstr("1900000"));
  EXPECT_THAT(lines[4], HasSubstr("'goal.droped'"));
  EXPECT_THAT(report.plans.planned, IsEmpty()) << "nothing is planned while something else is wrong";
}

// Numbers of a model of timelines that services give (docs/timeline-format.md).
TEST(MissionCheck, AModelOfTimelinesMayAskOnlyForWhatIsOffered) {
  const auto found = [](const std::string& asked, bool with_a_path_planner) {
    const CopiedMission copy(ROCI_SOURCE_DIR "/tests/missions/porter");
    const int line = copy.edit("porter.yaml", "numbers:\n",
                               "numbers:\n  drive_s: {arguments: [place, place], asked: " + asked + "}\n");
    if (with_a_path_planner)
      copy.edit(kMission, "model: porter.yaml",
                "  - {name: pathplan_svc, robot: porter}\nmodel: porter.yaml\nsite: " ROCI_SOURCE_DIR
                "/missions/planetary/site/site.yaml");
    const CheckReport report = check_mission(copy.folder());
    const std::string place = (copy.folder() / "porter.yaml").string() + ":" + std::to_string(line + 1) + ":";
    for (const mission::Finding& one : report.findings.all())
      EXPECT_THAT(one.text(), ::testing::StartsWith(place));
    return printed(report);
  };
  EXPECT_THAT(found("{module: pathplan, function: traverse_time}", false),
              ElementsAre(HasSubstr("no service of the mission offers module 'pathplan'; there is none")));
  EXPECT_THAT(found("{module: pathpaln, function: traverse_time}", true),
              ElementsAre(HasSubstr("offers module 'pathpaln'; did you mean 'pathplan'?")));
  EXPECT_THAT(found("{module: pathplan, function: traverse_tmie}", true),
              ElementsAre(HasSubstr("'pathplan' offers no function 'traverse_tmie'; did you mean "
                                    "'traverse_time'?")));
  EXPECT_THAT(found("{module: pathplan, function: traverse_time}", true), IsEmpty());
}

// What the mission's files hold for other services is read by these services themselves.
TEST(MissionCheck, AServiceOfTheMissionFindsAFaultInItsOwnFile) {
  const CopiedMission copy(kPlanetary);
  const int line = copy.edit("arm/poses.yaml", "margin: 0.01", "magrin: 0.01");
  const CheckReport report = check_mission(copy.folder());
  ASSERT_EQ(report.findings.size(), 1U) << ::testing::PrintToString(printed(report));
  EXPECT_THAT(report.findings.all().front().text(), HasSubstr("poses.yaml:" + std::to_string(line)));
}

TEST(MissionCheck, AllFaultsOfADomainAreFindingsAndNoDoubtOfTheRest) {
  const CopiedMission copy(kPlanetary);
  const int first = copy.edit("domain.pddl", "(over all (arm-at stow))", "(over all (arm-ta stow))");
  const int second = copy.edit("domain.pddl", "(at start (holding ?s))", "(at start (hodling ?s))");
  const CheckReport report = check_mission(copy.folder());
  const auto found = report.findings.sorted();
  ASSERT_EQ(found.size(), 2U) << ::testing::PrintToString(printed(report));
  EXPECT_EQ(found[0].line, first);
  EXPECT_EQ(found[1].line, second);
  for (const auto& one : found) EXPECT_EQ(fs::path(one.file).filename(), "domain.pddl");
  EXPECT_THAT(found[1].remedy, HasSubstr("holding"));
}

TEST(MissionCheck, WhatIsReadWithAWarningIsTold) {
  const CopiedMission copy(kPlanetary);
  const int line = copy.edit("domain.pddl", "(camera-idle)\n", "(camera-idle),\n");
  const CheckReport report = check_mission(copy.folder());
  ASSERT_EQ(report.findings.size(), 1U) << ::testing::PrintToString(printed(report));
  EXPECT_EQ(report.findings.errors(), 0U);
  EXPECT_EQ(report.findings.all().front().line, line);
  EXPECT_EQ(report.plans.planned.size(), 3U) << "it can be flown";
}

TEST(MissionCheck, AGoalKindThatNoScenarioAsksForIsPlannedByItsExample) {
  const CopiedMission copy(kPlanetary);
  fs::remove_all(copy.folder() / "scenarios");
  fs::create_directory(copy.folder() / "scenarios");
  std::ofstream(copy.folder() / "scenarios/nominal.yaml")
      << "duration_s: 100\nstart: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}\n";
  const CheckReport report = check_mission(copy.folder());
  EXPECT_THAT(printed(report), IsEmpty());
  EXPECT_EQ(report.plans.planned.size(), 2U);
  ASSERT_EQ(report.plans.not_tried.size(), 1U);
  EXPECT_EQ(report.plans.not_tried.front().kind, "drop_sample") << "its example names another goal";
}

}  // namespace
}  // namespace roci::rehearsal::check
