// Bad input to the programs that users start: each slip in a mission's files ends the start with exit code 2
// and a message that names file, line and remedy; what shows only in flight makes the robot safe, loses no
// goal, and is told (docs/exit-codes.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "exec_svc/journal/format.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/unit/exec_svc/golden/golden.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// A copy of the planetary mission, to be spoilt.
class SpoiltMission {
 public:
  SpoiltMission() : folder_(fs::temp_directory_path() / ("roci_spoilt_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder_ / "planetary", fs::copy_options::recursive);
  }
  ~SpoiltMission() { fs::remove_all(folder_); }

  std::string path() const { return folder_ / "planetary"; }

  void replace(const std::string& file, const std::string& right, const std::string& wrong) const {
    std::ostringstream in;
    in << std::ifstream(folder_ / "planetary" / file, std::ios::binary).rdbuf();
    std::string text = in.str();
    std::size_t changes = 0;
    for (auto at = text.find(right); at != std::string::npos; at = text.find(right, at + wrong.size())) {
      text.replace(at, right.size(), wrong);
      ++changes;
    }
    ASSERT_GT(changes, 0U) << right << " does not stand in " << file;
    std::ofstream(folder_ / "planetary" / file, std::ios::binary) << text;
  }
  void halve(const std::string& file) const {
    fs::resize_file(folder_ / "planetary" / file, fs::file_size(folder_ / "planetary" / file) / 2);
  }

  // With standard error in the output.
  Ended fly(const std::string& dds) const {
    return run("timeout 60 roci-launch " + path() + " --dds " + dds +
               " --speed max --headless --json --run-folder " + (folder_ / ("run-" + dds)).string() +
               " 2>&1");
  }

 private:
  fs::path folder_;
};

// No restart mends it: the run ends at once, and the journal is as it was.
TEST(NewerJournal, EndsTheRunWithCodeTwoAndTheRemedy) {
  const fs::path folder = fs::temp_directory_path() / ("roci_newer_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  sqlite3* database = nullptr;
  sqlite3_open((folder / "journal.sqlite").c_str(), &database);
  const std::string newer =
      "PRAGMA user_version = 99; PRAGMA application_id = " + std::to_string(0x524f0000 + 99);
  sqlite3_exec(database, (newer + "; CREATE TABLE kept(x)").c_str(), nullptr, nullptr, nullptr);
  sqlite3_close(database);
  const Ended ended = run("timeout 60 exec_svc --mission " + std::string(ROCI_SOURCE_DIR) +
                          "/missions/planetary --run-folder " + folder.string() + " 2>&1");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("journal.sqlite is not a usable journal: it is of format 99"),
                                  HasSubstr("go on with the version that wrote it")));
  fs::remove_all(folder);
}

// Their bytes mean something else there, so that none is read.
TEST(InputsOfAnotherVersion, AreNotReplayed) {
  const fs::path file =
      fs::temp_directory_path() / ("roci_other_inputs_" + std::to_string(::getpid()) + ".sqlite");
  fs::remove(file);
  exec::testing::make_golden_journal(1, file);
  for (std::int64_t version = 1; version <= exec::journal::kInputFormat + 1; ++version) {
    if (version == exec::journal::kInputFormat) continue;
    const std::string number = std::to_string(version);
    exec::testing::execute(file, "UPDATE number SET value = " + number + " WHERE name = 'format'");
    const Ended ended = run("roci-replay " + file.string() + " 2>&1");
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_THAT(ended.output, AllOf(HasSubstr("holds inputs of format " + number + ", this"),
                                    HasSubstr("repeat the run with the version that flew it")));
  }
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(file.string() + suffix);
}

// What a unit of systemd starts: the service that the mission's list has under this name.
TEST(Become, TheProcessTurnsIntoAServiceOfTheList) {
  const fs::path folder = fs::temp_directory_path() / ("roci_become_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "mission.yaml")
      << "name: mine\nrobots: [scout]\nservices:\n"
         "  - {name: left.drill, program: ./drill, robot: scout, arguments: [--bit, 3]}\n";
  std::ofstream(folder / "drill") << "#!/bin/sh\necho \"$@\"\n";
  fs::permissions(folder / "drill", fs::perms::owner_all);
  const Ended ended =
      run("roci-launch " + folder.string() + " --become left.drill --clock live --epoch 5 2>&1");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("--name left.drill"), HasSubstr("--robot scout"),
                                  HasSubstr("--bit 3"), HasSubstr("--clock live"), HasSubstr("--epoch 5")));
  const Ended wrong = run("roci-launch " + folder.string() + " --become drill --clock live 2>&1");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("unknown service drill; this mission has: left.drill"));
  fs::remove_all(folder);
}

struct Slip {
  const char* name;
  const char* file;
  const char* right;  // empty: half of the file is cut off
  const char* wrong;
  const char* told;
  const char* tries = "";  // told, too
};

void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.name; }

class BadFile : public ::testing::TestWithParam<Slip> {};

TEST_P(BadFile, EndsTheStartWithPlaceAndRemedy) {
  const Slip& slip = GetParam();
  const SpoiltMission mission;
  if (*slip.right == '\0') {
    mission.halve(slip.file);
  } else {
    mission.replace(slip.file, slip.right, slip.wrong);
  }
  for (const char* dds : {"cyclonedds", "inproc"}) {
    const Ended ended = mission.fly(dds);
    EXPECT_EQ(ended.exit_code, 2) << dds << "\n" << ended.output;
    EXPECT_THAT(ended.output, AllOf(ContainsRegex(std::string(slip.file) + ":[0-9]+"), HasSubstr(slip.told)))
        << dds;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadFile,
    ::testing::Values(
        Slip{"domain", "domain.pddl", "(at ?l - location)", "(at ?l - locatoin)", "declare it in :types"},
        Slip{"domain_cut_off", "domain.pddl", "", "", "never closed"},
        Slip{"mission_syntax", "mission.yaml", "name: planetary", "name: [planetary",
             "mend the syntax there"},
        Slip{"mission_key", "mission.yaml", "ack_timeout_s", "ack_timout_s", "known here: ack_timeout_s"},
        Slip{"mission_number", "mission.yaml", "radius_m: 0.8", "radius_m: wide", "expected a finite number"},
        Slip{"mission_action", "mission.yaml", "transmit: {owner", "transmute: {owner",
             "the domain has no action"},
        Slip{"mission_component", "mission.yaml", "component: nav,", "component: wheels,",
             "declare it under"},
        Slip{"site", "site/site.yaml", "resolution:", "resolutoin:", "known here"},
        Slip{"rocks_cut_off", "site/rocks.pgm", "", "", "generate or copy the file again"},
        Slip{"elevation_cut_off", "site/elevation.pgm", "", "", "generate or copy the file again"},
        Slip{"arm_syntax", "arm/arm.urdf", "</robot>", "", "mend the syntax"},
        Slip{"arm_joint", "arm/arm.urdf", "type=\"revolute\"", "type=\"rubber\"", "is not one of revolute"},
        Slip{"poses", "arm/poses.yaml", "joints:", "jionts:", "jionts"},
        Slip{"scenario_key", "scenarios/nominal.yaml", "duration_s: 14400", "duration: 14400", "known here"},
        Slip{"scenario_number", "scenarios/nominal.yaml", "at_s: 10", "at_s: ten",
             "expected a finite number"}),
    [](const auto& test) { return std::string(test.param.name); });

// What a newcomer mistypes: the answer names it, and the code is that of a wrong command line.
TEST(BadCommandLine, NamesWhatWasMistyped) {
  const std::string mission = ROCI_SOURCE_DIR "/missions/planetary";
  const std::pair<std::string, const char*> slips[] = {
      {"roci gaol list", "roci: 'gaol' is no verb of roci; did you mean 'goal'?; roci --help lists them"},
      {"roci goal ad x photo", "roci: 'ad' is no verb of roci goal; did you mean 'add'?"},
      {"roci --domain 7 stauts", "did you mean 'status'?"},
      {"roci-launch " + mission + " --seed -3", "--seed: '-3' is no number from 0 on"},
      {"roci-rehearse " + mission + " --runs 0", "--runs: '0' is no number above 0"},
      {"roci-rehearse " + mission + " --speed fast", "fast"},
      {"roci-check " + mission + " --scenario nominel", "did you mean 'nominal'?"},
      {"roci-launch nowhere", "no mission \"nowhere\": give a folder with a mission.yaml"},
      {"roci-rehearse nowhere", "no mission \"nowhere\": give a folder with a mission.yaml"},
      {"roci-keys make", "mission is required"},
      {"roci-keys make nowhere", "roci-keys: nowhere/mission.yaml: cannot be read"},
      {"roci-site --side 100", "--out is required"}};
  for (const auto& [line, words] : slips) {
    const Ended ended = run("timeout 20 " + line + " 2>&1");
    EXPECT_EQ(ended.exit_code, 2) << line << ": " << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(words)) << line;
  }
}

TEST(BadCommandLine, IsToldWithTheRemedy) {
  const std::string planetary = ROCI_SOURCE_DIR "/missions/planetary";
  Ended ended = run("timeout 60 roci-launch " + planetary + " --scenario nowhere --headless 2>&1");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("nowhere"), HasSubstr("nominal"), Not(HasSubstr("goals"))))
      << "nothing was started";
  ended = run("timeout 60 roci-launch " + planetary + " --dds smoke --headless 2>&1");
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("smoke"), HasSubstr("cyclonedds"), HasSubstr("fastdds")));
  ended = run("timeout 60 roci-timelines check " ROCI_SOURCE_DIR "/missions/faster 2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("is a folder"));
  ended = run("timeout 60 roci goal add 2>&1");
  EXPECT_EQ(ended.exit_code, 2);
  const SpoiltMission mission;
  ended = run("timeout 60 planner_svc --dds smoke --domain 99 --mission " + mission.path() +
              " --run-folder " + mission.path() + " 2>&1");
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_THAT(ended.output, HasSubstr("cyclonedds"));
}

// What no file shows: the robot is made safe, its goals wait for the ground, standard error says why.
class InFlight : public ::testing::TestWithParam<Slip> {};

TEST_P(InFlight, MakesTheRobotSafeLosesNoGoalAndIsTold) {
  const Slip& slip = GetParam();
  const SpoiltMission mission;
  mission.replace(slip.file, slip.right, slip.wrong);
  const Ended ended = mission.fly("cyclonedds");
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "partial");
  EXPECT_EQ(summary["goals"].value("achieved", 0) + summary["goals"].value("open", 0), 3) << summary.dump();
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("robot.safe: made safe, waiting for the ground"), HasSubstr(slip.told)));
}

INSTANTIATE_TEST_SUITE_P(
    Surprises, InFlight,
    ::testing::Values(Slip{"unknown_module", "domain.pddl", ":module arm", ":module arms",
                           "no service offers module 'arms'; offered are: arm, pathplan"},
                      Slip{"unknown_engine", "mission.yaml", "engine: temporal_pddl", "engine: crystal",
                           "unknown engine 'crystal'; this planner has: temporal_pddl"}),
    [](const auto& test) { return std::string(test.param.name); });

// The scenario asks for what the mission cannot take: nobody else reads the rejection.
TEST(ScenariosGoal, ThatIsRejectedIsAHardGoalNotAchieved) {
  const SpoiltMission mission;
  mission.replace("scenarios/nominal.yaml", "id: ridge, kind: photo", "id: ridge, kind: photograph");
  for (const char* dds : {"cyclonedds", "inproc"}) {
    const Ended ended = mission.fly(dds);
    EXPECT_EQ(ended.exit_code, 1) << ended.output;
    const nlohmann::json summary = last_line_as_json(ended.output);
    EXPECT_EQ(summary.value("result", ""), "partial");
    EXPECT_EQ(summary["goals"].value("achieved", 0), 2) << summary.dump();
    EXPECT_EQ(summary["goals"].value("rejected", 0), 1) << summary.dump();
  }
}

// A command that its owner never takes costs the goal that needs it, and no other.
class NeverTaken : public ::testing::TestWithParam<Slip> {};

TEST_P(NeverTaken, FailsItsGoalAloneAndIsTold) {
  const Slip& slip = GetParam();
  const SpoiltMission mission;
  mission.replace(slip.file, slip.right, slip.wrong);
  if (std::string(slip.wrong) == ": eye")  // the robot itself still has its camera
    mission.replace(slip.file, "{name: eye, type: eye", "{name: camera, type: camera");
  const Ended ended = mission.fly("cyclonedds");
  EXPECT_EQ(ended.exit_code, 1) << ended.output;
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "partial");
  EXPECT_EQ(summary["goals"].value("achieved", 0), 2) << summary.dump();
  EXPECT_EQ(summary["goals"].value("failed", 0), 1) << summary.dump();
  EXPECT_THAT(ended.output, AllOf(HasSubstr("goal.failed: hard goal ground/ridge failed: "),
                                  HasSubstr(slip.tries), HasSubstr(slip.told)));
}

INSTANTIATE_TEST_SUITE_P(
    Surprises, NeverTaken,
    ::testing::Values(Slip{"unknown_component", "mission.yaml", ": camera", ": eye",
                           "[unknown-component]: no component 'eye'; known: nav, arm, camera, gripper, radio",
                           "will never be taken"},
                      Slip{"unknown_command", "mission.yaml", "command: image", "command: photograph",
                           "[unknown-command]: camera has no command 'photograph'; known: image, stop",
                           "will never be taken"},
                      Slip{"unknown_owner", "mission.yaml", "take-image: {owner: sim_svc",
                           "take-image: {owner: eye_svc", "command not answered by eye_svc within 5 s",
                           "failed 8 times in a row"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
