// Bad input to missions of hierarchical timelines and dedicated executives, by the programs that users start: each is
// refused, named to whom it concerns, and what does not depend on it goes on.
// The table says which test shows each sentence of the kind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

struct Shown {
  const char* input;
  const char* file;
  const char* test;  // "Suite, Name", as in the source
};

constexpr Shown kShown[] = {
    {"a domain with unknown components or states", "tests/scenario/two_rovers_bad_input_test.cpp",
     "SpoiltModel, MakesTheRobotSafeAndIsToldWithItsPlace"},
    {"behaviours that never end", "tests/unit/planner_svc/timeline_htn/reading/faults_test.cpp",
     "TimelineModelFaults, BehavioursThatNeverEndAreNamed"},
    {"behaviours that contradict themselves in time",
     "tests/unit/planner_svc/timeline_htn/reading/faults_test.cpp",
     "TimelineModelFaults, BehavioursThatContradictThemselvesInTimeAreNamed"},
    {"goals of no component", "tests/scenario/two_rovers_bad_input_test.cpp",
     "TwoRoversBadInput, AGoalOfNoComponentFailsAlone"},
    {"a problem without the state of a subsystem",
     "tests/unit/planner_svc/timeline_htn/reading/faults_test.cpp",
     "TimelineModelFaults, WhatContradictsItselfIsToldAtItsPart"},
    {"a map patch off the map, not finite, older than what is known, from nobody",
     "tests/unit/pathplan_svc/map_exchange_test.cpp", "MapExchange, "},
    {"a decision answered late, twice or with an unknown choice",
     "tests/scenario/two_rovers_bad_input_test.cpp",
     "OpenDecision, IsAnsweredOnceInTimeWithAChoiceThatThereIs"},
    {"two owners of one subsystem", "tests/scenario/two_rovers_bad_input_test.cpp",
     "SecondOwner, OfASubsystemEndsTheStartWithItsPlace"},
    {"two owners of one subsystem, on a unit of its own", "tests/unit/dedicated_svc/sole_owner_test.cpp",
     "SoleOwner, "},
    {"two processes of one name", "tests/unit/services/namesake_watch_test.cpp", "NamesakeWatch, "},
    {"a vendor missing on one rover", "tests/scenario/two_rovers_bad_input_test.cpp",
     "TwoRoversBadInput, AMissingVendorIsNamedWithTheServiceThatWantsIt"},
    {"a plan for a robot that is not there", "tests/scenario/two_rovers_bad_input_test.cpp",
     "TwoRoversBadInput, NoPlanIsMadeForARobotThatIsNotThere"},
    {"readers, damaged", "tests/fuzz/timeline_models/fuzz_test.cpp",
     "FuzzTimelineModels, ADamagedFileIsTakenOrRefusedWithItsPlace"},
    {"methods of dedicated executives, damaged", "tests/fuzz/missions/fuzz_test.cpp", "dedicated.yaml"},
};

TEST(TwoRoversBadInput, EachKindHasItsTest) {
  for (const Shown& shown : kShown)
    EXPECT_THAT(text_of(fs::path(ROCI_SOURCE_DIR) / shown.file), HasSubstr(shown.test)) << shown.input;
}

// A copy of a mission of tests/missions.
class Copy {
 public:
  explicit Copy(const std::string& name)
      : folder_(fs::temp_directory_path() / ("roci_two_rovers_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/" + name, mission(), fs::copy_options::recursive);
  }
  ~Copy() { fs::remove_all(folder_); }

  fs::path mission() const { return folder_ / "mission"; }
  fs::path run_folder() const { return folder_ / "run"; }
  void edit(const std::string& file, const std::string& right, const std::string& wrong) const {
    scenario::edit(mission() / file, right, wrong);
  }
  // With standard error in the output.
  Ended fly(const std::string& dds = "cyclonedds") const {
    return run("timeout 60 roci-launch " + mission().string() + " --dds " + dds +
               " --speed max --headless --json --run-folder " + run_folder().string() + " 2>&1");
  }

 private:
  fs::path folder_;
};

struct Slip {
  const char* name;
  const char* right;
  const char* wrong;
  const char* told;
};

void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.name; }

class SpoiltModel : public ::testing::TestWithParam<Slip> {};

TEST_P(SpoiltModel, MakesTheRobotSafeAndIsToldWithItsPlace) {
  const Slip& slip = GetParam();
  const Copy porter("porter");
  porter.edit("porter.yaml", slip.right, slip.wrong);
  const Ended ended = porter.fly();
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("robot.safe: made safe, waiting for the ground"), HasSubstr(slip.told)));
  EXPECT_EQ(last_line_as_json(ended.output)["goals"].value("open", 0), 2) << "no goal is lost";
}

INSTANTIATE_TEST_SUITE_P(
    Models, SpoiltModel,
    ::testing::Values(Slip{"component", "lift: \"gripper.", "lift: \"griper.",
                           ":67:13: unknown component 'griper'; did you mean 'gripper'?"},
                      Slip{"state", "put: gripper.setting_down(crate)\n    constraints",
                           "put: gripper.seting_down(crate)\n    constraints",
                           ":68:12: unknown state 'seting_down'; did you mean 'setting_down'?"},
                      Slip{"endless", "subgoals: {put: gripper.setting_down(crate)}",
                           "subgoals: {again: errand.fetching(crate)}", "behaviour 'bring': it never ends"},
                      Slip{"contradiction", "[lift before put]", "[lift before put before lift]",
                           "behaviour 'fetch': it contradicts itself in time"},
                      Slip{"no_state", "{errand: idle}", "{}",
                           "it is not known in which state 'errand' is: no timeline of it was observed; say "
                           "'observed' of its "
                           "states, or its state under 'initial'"},
                      Slip{"goal", "goals: {}", "goals: {x: erand.fetched(red)}",
                           ":77:14: unknown component 'erand'; did you mean 'errand'?"},
                      Slip{"robot", "robot: porter", "robot: carrier",
                           "but robot 'carrier' has no such subsystem; it has: base of sim_svc"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(TwoRoversBadInput, AGoalOfNoComponentFailsAlone) {
  const Copy porter("porter");
  porter.edit("scenarios/nominal.yaml", "arguments: {crate: blue}", "arguments: {crate: green}");
  const Ended ended = porter.fly();
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("goal.failed: hard goal ground/blue failed: out of reach: 'errand = "
                                      "fetched(green)' is no state of a component of the model"));
  const json goals = last_line_as_json(ended.output)["goals"];
  EXPECT_EQ(goals.value("achieved", 0), 1);
  EXPECT_EQ(goals.value("failed", 0), 1);
}

class SecondOwner : public ::testing::TestWithParam<const char*> {};

TEST_P(SecondOwner, OfASubsystemEndsTheStartWithItsPlace) {
  const Copy convoy("convoy");
  convoy.edit("mission.yaml", "services:\n",
              "services:\n  - {name: " + std::string(GetParam()) +
                  ", program: dedicated_svc, robot: scout, settings: scout.yaml}\n");
  const Ended ended = convoy.fly();
  EXPECT_EQ(ended.exit_code, 2) << ended.output;
  const bool namesake = std::string(GetParam()) == "scout.locomotion";
  EXPECT_THAT(ended.output,
              ContainsRegex(namesake ? "mission.yaml:[0-9]+:[0-9]+: service 'scout.locomotion' stands twice"
                                     : "scout.yaml:5:13: 'scout.locomotion' belongs to scout.locomotion"));
}

INSTANTIATE_TEST_SUITE_P(Names, SecondOwner, ::testing::Values("a.second", "scout.locomotion"),
                         [](const auto& test) {
                           return std::string(test.param) == "a.second" ? "of_the_timeline" : "of_the_name";
                         });

TEST(TwoRoversBadInput, AMissingVendorIsNamedWithTheServiceThatWantsIt) {
  const Copy convoy("convoy");
  convoy.edit("mission.yaml", "settings: scout.yaml}", "settings: scout.yaml, vendor: smoke}");
  const Ended ended = convoy.fly("mixed");
  EXPECT_EQ(ended.exit_code, 3) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("scout.locomotion ended with code 3"),
                    HasSubstr("unknown DDS transport \"smoke\"; installed: cyclonedds, fastdds"),
                    HasSubstr("the `vendor` of the service in mission.yaml")));
}

// Nobody has ever heard of its scout: the wish for a plan waits, and says for whom.
TEST(TwoRoversBadInput, NoPlanIsMadeForARobotThatIsNotThere) {
  const Copy convoy("convoy");
  convoy.edit("mission.yaml",
              "  - {name: scout.locomotion, program: dedicated_svc, robot: scout, settings: scout.yaml}\n",
              "");
  convoy.edit("scenarios/nominal.yaml", "duration_s: 3600", "duration_s: 120");
  const Ended ended = convoy.fly();
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  EXPECT_THAT(journaled_events(convoy.run_folder() / "journal.sqlite"),
              Contains("plan.waits goal ground/far arrived; no plan before these were observed: scout "
                       "(scout.locomotion of scout.locomotion)"));
  EXPECT_EQ(last_line_as_json(ended.output)["goals"].value("open", 0), 1);
}

// R131. The porter may set a crate down or hand it over; the ground decides, and the mission goes on whatever it says.
TEST(OpenDecision, IsAnsweredOnceInTimeWithAChoiceThatThereIs) {
  const Copy porter("porter");
  porter.edit("porter.yaml", "    constraints: [lift before put]\n",
              "      crane: gripper.handing_over(crate)\n"
              "    constraints: [lift before put, lift before crane]\n"
              "    decisions:\n"
              "      how: {resolver: ground, before: put.start, choices: {floor: {subgoals: put}, crane: "
              "{subgoals: crane}}}\n");
  porter.edit(
      "porter.yaml", "    transitions:\n      - \"empty -> lifting",
      "      handing_over:\n"
      "        kind: simple\n        parameters: {crate: crate}\n        duration_s: [5, 60]\n"
      "        command: {owner: sim_svc, component: gripper, command: hand_over, arguments: {crate: crate}}\n"
      "    transitions:\n      - \"holding(x) -> handing_over(x)\"\n      - \"handing_over(x) -> empty\"\n"
      "      - \"empty -> lifting");
  porter.edit("porter.yaml", "horizon_s: 7200", "horizon_s: 400");
  porter.edit(
      "mission.yaml", "            set_down: {",
      "            hand_over: {arguments: [crate], duration_s: 10, during: setting-down, then: empty}\n"
      "            set_down: {");
  porter.edit(
      "scenarios/nominal.yaml", "expect:\n",
      "  - {at_s: 900, recall: {issuer: ground, id: red}}\nexpect:\n");  // the flight does not end before
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/open_decisions.sh ${ROCI_BIN:-" ROCI_BINARY_DIR
          "/bin} " +
          porter.mission().string() + " cyclonedds " + std::to_string(domain.id()) + " floor");
  const auto steps = steps_of(ended.output);
  ASSERT_EQ(steps.size(), 5U) << ended.output;
  const auto reason = [&](const char* step) {
    return steps.at(step).printed.value("reason", "none was given");
  };
  EXPECT_EQ(steps.at("unknown").exit_code, 1);
  EXPECT_EQ(reason("unknown"), "there is no choice 'nowhere'; one of: floor, crane");
  EXPECT_EQ(steps.at("taken").exit_code, 0) << ended.output;
  EXPECT_EQ(steps.at("twice").exit_code, 1);
  EXPECT_EQ(reason("twice"), "it was answered with floor before");
  EXPECT_EQ(steps.at("late").exit_code, 1);
  EXPECT_THAT(reason("late"), HasSubstr("it was due before "));
  EXPECT_EQ(steps.at("launch").printed["goals"].value("achieved", 0), 2) << ended.output;
}

}  // namespace
}  // namespace roci::scenario
