// The parts of roci-launch: what it starts, what it leaves and what it reads again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/launch/anchor_file.hpp"
#include "services/launch/child.hpp"
#include "services/launch/continuation.hpp"
#include "services/launch/log_files.hpp"
#include "services/launch/options.hpp"
#include "services/launch/process_plan.hpp"
#include "services/launch/summary.hpp"
#include "services/process/mission_folder.hpp"
#include "services/process/run_record.hpp"
#include "services/process/service_options.hpp"

namespace roci::services::launch {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

namespace fs = std::filesystem;

class LaunchTest : public testing::Test {
 protected:
  LaunchTest() {
    fs::create_directories(folder);
    std::ofstream(folder / "mission.yaml")
        << "name: test\n"
           "robots: [rover]\n"
           "services:\n"
           "  - {name: arm_svc, robot: rover}\n"
           "  - {name: exec_svc, standby: true}\n"
           "  - {name: planner_svc, vendor: cyclonedds}\n"
           "  - {name: sim_svc, clock: master}\n"
           "  - {name: second.arm, program: arm_svc, arguments: [--seed, 12]}\n";
  }
  ~LaunchTest() override { fs::remove_all(folder); }

  Options parse(std::vector<std::string> arguments) const {
    std::vector<const char*> pointers{"roci-launch", folder.c_str()};
    for (const auto& argument : arguments) pointers.push_back(argument.c_str());
    return parse_options(static_cast<int>(pointers.size()), pointers.data(),
                         [](const char*) { return std::nullopt; });
  }

  fs::path folder =
      fs::temp_directory_path() / ("roci-launch-" + std::to_string(getpid()) +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(LaunchTest, MixedPutsWhoNamesItAndTheConsoleOnTheOtherVendor) {
  const Options options = parse({"--dds", "mixed"});
  EXPECT_THAT(service_arguments(options, "planner_svc", 1, 0), Contains("cyclonedds"));
  EXPECT_THAT(service_arguments(options, "exec_svc", 1, 0), Contains("fastdds"));
  EXPECT_EQ(console_vendor("mixed"), "cyclonedds");
  EXPECT_EQ(console_vendor("fastdds"), "fastdds");
  EXPECT_THAT(service_arguments(parse({"--dds", "fastdds"}), "planner_svc", 1, 0),
              Not(Contains("cyclonedds")));
}

TEST_F(LaunchTest, NetworkFileAndKeysReachEveryProcess) {
  std::ofstream(folder / "network.yaml") << "address: 127.0.0.1\npeers: []\n";
  const std::string network = folder / "network.yaml", keys = folder / "keys";
  const Options options = parse({"--dds", "mixed", "--network", network, "--secure=" + keys});
  for (const std::string& service : options.services) {
    const auto arguments = service_arguments(options, service, 1, 0);
    EXPECT_THAT(arguments, IsSupersetOf({std::string("--network"), network})) << service;
    EXPECT_THAT(arguments, Contains("--secure=" + keys)) << service;
  }
  EXPECT_THAT(service_arguments(parse({"--dds", "mixed"}), "sim_svc", 1, 0),
              Not(Contains(HasSubstr("--secure"))));
}

TEST_F(LaunchTest, WhatCannotBeSecureIsRefused) {
  std::ofstream(folder / "vendor.xml") << "<dds/>";
  std::ofstream(folder / "network.yaml") << "vendor_xml: vendor.xml\n";
  const std::string network = folder / "network.yaml";
  EXPECT_THROW(parse({"--dds", "inproc", "--secure=/keys"}), std::invalid_argument);
  EXPECT_THROW(parse({"--dds", "fastdds", "--network", network, "--secure=/keys"}), std::invalid_argument);
  EXPECT_THROW(parse({"--dds", "mixed", "--network", network}), std::invalid_argument)
      << "of which vendor it is?";
  EXPECT_EQ(parse({"--dds", "fastdds", "--network", network}).connection.transport.vendor_xml,
            folder / "vendor.xml");
}

TEST_F(LaunchTest, APaceIsAFiniteNumberAboveZero) {
  for (const char* speed : {"0", "-1", "nan", "inf", "1e999", "fast", "2x"})
    EXPECT_THROW(parse({"--speed", speed}), std::invalid_argument) << speed;
}

TEST_F(LaunchTest, OnlyTheMasterKnowsRosterAndPace) {
  const Options options = parse({"--speed", "max"});
  EXPECT_THAT(service_arguments(options, "sim_svc", 3, 0),
              IsSupersetOf({"master", "--roster", "arm_svc,exec_svc,planner_svc,sim_svc,second.arm", "--pace",
                            "0", "--incarnation", "3"}));
  EXPECT_THAT(service_arguments(options, "arm_svc", 1, 0), Contains("simulated"));
  EXPECT_THAT(service_arguments(options, "arm_svc", 1, 0), Not(Contains("--roster")));
}

TEST_F(LaunchTest, AStandbyIsASecondExecutiveAndNoMemberOfTheRoster) {
  const Options options = parse({"--standby", "--dds", "mixed"});
  EXPECT_THAT(options.services, Contains("exec_svc.standby"));
  EXPECT_THAT(options.roster, Not(Contains("exec_svc.standby")));
  EXPECT_THAT(service_arguments(options, "exec_svc", 1, 0), IsSupersetOf({"exec_svc", "--pair", "first"}));
  EXPECT_THAT(service_arguments(options, "exec_svc.standby", 1, 0),
              IsSupersetOf({"exec_svc", "--pair", "second", "cyclonedds"}));
  EXPECT_THAT(service_arguments(options, "arm_svc", 1, 0), Not(Contains("--pair")));
  EXPECT_THAT(service_arguments(parse({}), "exec_svc", 1, 0), Not(Contains("--pair")));
  EXPECT_THAT(parse({"--standby", "--services", "exec_svc.standby"}).services,
              ElementsAre("exec_svc.standby"));
  EXPECT_THROW(parse({"--services", "exec_svc.standby"}), std::invalid_argument);
  EXPECT_THROW(parse({"--standby", "--dds", "inproc"}), std::invalid_argument);
}

TEST_F(LaunchTest, TheMissionSaysWhichServicesThereAre) {
  const Options options = parse({});
  EXPECT_THAT(options.services, ElementsAre("arm_svc", "exec_svc", "planner_svc", "sim_svc", "second.arm"));
  EXPECT_THAT(service_arguments(options, "second.arm", 1, 0),
              IsSupersetOf({"arm_svc", "--name", "second.arm", "--seed", "12"}));
  EXPECT_THAT(service_arguments(options, "arm_svc", 1, 0), IsSupersetOf({"--robot", "rover"}));
  EXPECT_THAT(service_arguments(options, "sim_svc", 1, 0), Not(Contains("--robot")));
  std::ofstream(folder / "mission.yaml") << "name: test\nservices:\n  - {name: exec_svc}\n";
  EXPECT_THROW(parse({}), std::invalid_argument) << "nobody drives the simulated clock";
  EXPECT_THAT(parse({"--clock", "live"}).services, ElementsAre("exec_svc"));
  EXPECT_THROW(parse({"--clock", "live", "--standby"}), std::invalid_argument) << "nobody may be paired";
  std::ofstream(folder / "mission.yaml") << "name: test\n";
  EXPECT_THROW(parse({}), mission::FileError);
}

TEST_F(LaunchTest, ARunHasAnIdentityThatItsHostsShare) {
  EXPECT_NE(parse({}).run, parse({}).run) << "flown by one launcher it is like no other";
  EXPECT_EQ(parse({"--services", "arm_svc"}).run, parse({"--services", "sim_svc,exec_svc"}).run);
  const Options named = parse({"--run", "sol-12"});
  EXPECT_EQ(named.run, "sol-12");
  EXPECT_THAT(service_arguments(named, "arm_svc", 1, 0), IsSupersetOf({"--run", "sol-12"}));
}

TEST_F(LaunchTest, TheMasterOfTheClockKnowsWhomNobodyNeeds) {
  std::ofstream(folder / "mission.yaml") << "name: test\nservices:\n  - {name: sim_svc, clock: master}\n"
                                            "  - {name: science_svc, essential: false}\n";
  EXPECT_THAT(service_arguments(parse({}), "sim_svc", 1, 0),
              IsSupersetOf({"--roster", "sim_svc,science_svc?"}));
  std::ofstream(folder / "mission.yaml")
      << "name: test\nservices:\n  - {name: sim_svc, clock: master, essential: false}\n";
  EXPECT_THROW(parse({}), mission::FileError);
}

TEST_F(LaunchTest, ALiveRunGoesOnAsItWasStarted) {
  Options options =
      parse({"--clock", "live", "--speed", "2", "--seed", "9", "--dds", "cyclonedds", "--standby"});
  options.run_folder = folder;
  const clock::HostAnchor anchor = clock::anchor_host();
  keep_command_line(options, anchor, 1'700'000'000'000'000);
  const auto resume = [&](const std::vector<std::string>& more) {
    std::vector<const char*> pointers{"roci-launch", "--resume", folder.c_str()};
    for (const auto& argument : more) pointers.push_back(argument.c_str());
    return parse_options(static_cast<int>(pointers.size()), pointers.data(),
                         [](const char*) { return std::nullopt; });
  };
  Options again = resume({"--json", "--watchdog", "4"});
  ASSERT_TRUE(again.continued);
  EXPECT_EQ(again.continued->epoch_unix_us, 1'700'000'000'000'000);
  EXPECT_EQ(again.continued->anchor, anchor);
  EXPECT_EQ(again.continued->incarnations(), 10'000U);
  EXPECT_EQ(again.mission, options.mission);
  EXPECT_EQ(again.run, options.run) << "its owners know it by that name";
  EXPECT_EQ(again.seed, 9U);
  EXPECT_EQ(again.speed, 2.0);
  EXPECT_EQ(again.services, options.services);
  EXPECT_EQ(again.roster, options.roster);
  EXPECT_TRUE(again.standby);
  EXPECT_TRUE(again.json);
  EXPECT_EQ(again.watchdog_s, 4);
  EXPECT_EQ(again.run_folder, folder);
  keep_command_line(again, anchor, again.continued->epoch_unix_us);
  EXPECT_EQ(resume({}).continued->incarnations(), 20'000U);
}

TEST_F(LaunchTest, WhatCannotBeResumedIsRefusedInWords) {
  const auto complaint = [&](const std::vector<const char*>& more = {}) {
    std::vector<const char*> pointers{"roci-launch", "--resume", folder.c_str()};
    pointers.insert(pointers.end(), more.begin(), more.end());
    try {
      parse_options(static_cast<int>(pointers.size()), pointers.data(),
                    [](const char*) { return std::nullopt; });
      return std::string();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(complaint(), HasSubstr("there is no launch.json of a run in it"));
  const std::vector<const char*> slip{"roci-launch", "--resume", "--run-folder", folder.c_str()};
  EXPECT_THROW(parse_options(4, slip.data(), [](const char*) { return std::nullopt; }),
               std::invalid_argument);
  Options options = parse({"--dds", "cyclonedds"});
  options.run_folder = folder;
  keep_command_line(options, clock::anchor_host(), 0);
  EXPECT_THAT(complaint(), HasSubstr("only runs with --clock live are resumed"));
  options = parse({"--clock", "live", "--dds", "cyclonedds"});
  options.run_folder = folder;
  keep_command_line(options, clock::anchor_host(), 0);
  EXPECT_EQ(complaint({"--scenario", "nominal", "--seed", "1", "--speed", "3"}), "");
  EXPECT_THAT(complaint({"--clock", "simulated"}), HasSubstr("started with --clock live, and cannot go on with"));
  EXPECT_THAT(complaint({"--scenario", "other"}), HasSubstr("--scenario nominal"));
  EXPECT_THAT(complaint({"--seed", "77"}), HasSubstr("--seed 1,"));
  EXPECT_THAT(complaint({"--run", "another"}), HasSubstr("--run "));
  EXPECT_THAT(complaint({"--become", "sim_svc"}), HasSubstr("--become"));
  for (const char* damage :
       {R"({"clock": "live"})", R"({"format": "x", "clock": "live"})", R"({"format": [1]})",
        R"({"format": null})", R"({"format": 1, "clock": 5})", R"({"format": 1, "clock": "live", "arguments": 7})"}) {
    std::ofstream(folder / "launch.json") << damage;
    EXPECT_THAT(complaint(), HasSubstr("launch.json is damaged")) << damage;
  }
  const FolderLock lock(folder);
  EXPECT_THROW(FolderLock{folder}, std::invalid_argument) << "its launcher lives";
}

TEST_F(LaunchTest, LiveServicesShareAnEpoch) {
  const Options options = parse({"--clock", "live", "--speed", "2"});
  EXPECT_THAT(service_arguments(options, "sim_svc", 1, 1'700'000'000'250'000),
              IsSupersetOf({"--clock", "live", "--scale", "2", "--epoch", "1700000000.25"}));
}

TEST_F(LaunchTest, OneServiceOfTheListStartsUnderAnotherSupervisor) {
  Options options = parse({"--become", "second.arm", "--clock", "live", "--epoch", "5"});
  EXPECT_EQ(options.become, "second.arm");
  EXPECT_EQ(options.run, folder.filename().string()) << "each service of the run comes to the same identity";
  EXPECT_THAT(service_arguments(options, options.become, 0, 5'000'000), Not(Contains("--incarnation")));
  EXPECT_THROW(parse({"--become", "second.arm"}), std::invalid_argument);
  EXPECT_THROW(parse({"--become", "nobody", "--clock", "live"}), std::invalid_argument);
}

TEST_F(LaunchTest, ServiceArgumentsAreThoseThatServicesRead) {
  Options options = parse({"--dds", "cyclonedds", "--seed", "9", "--domain", "7", "--speed", "2.5"});
  options.run_folder = "/run";
  for (const mission::ServiceEntry& entry : options.list.services) {
    const std::string& service = entry.name;
    if (!entry.arguments.empty()) continue;  // they are its program's own
    const auto arguments = service_arguments(options, service, 2, 0);
    std::vector<const char*> pointers;
    for (const auto& argument : arguments) pointers.push_back(argument.c_str());
    const auto read = process::parse_service_options(static_cast<int>(pointers.size()), pointers.data(),
                                                     service, [](const char*) { return std::nullopt; });
    EXPECT_EQ(read.node.name, service);
    EXPECT_EQ(read.node.incarnation, 2U);
    EXPECT_EQ(read.run.seed, 9U);
    EXPECT_EQ(read.run.mission, options.mission);
    EXPECT_EQ(read.connection.dds, "cyclonedds");
    EXPECT_EQ(read.connection.transport.domain, 7);
    EXPECT_EQ(read.node.run, options.run);
    EXPECT_EQ(read.node.robot, entry.robot);
    EXPECT_EQ(read.run.mission_file(), entry.settings);
    const bool master = entry.clock_master;
    EXPECT_EQ(read.node.clock, master ? clock::ClockMode::master : clock::ClockMode::simulated);
    EXPECT_EQ(read.node.master.pace, master ? 2.5 : 0);
  }
}

TEST_F(LaunchTest, MistakesOnTheCommandLineAreExplained) {
  EXPECT_THROW(parse({"--clock", "lunar"}), process::CommandLineEnd);
  EXPECT_THROW(parse({"--speed", "fast"}), std::invalid_argument);
  EXPECT_THROW(parse({"--speed", "-1"}), std::invalid_argument);
  EXPECT_THROW(parse({"--speed", "max", "--clock", "live"}), std::invalid_argument);
  EXPECT_THROW(parse({"--services", "leg_svc"}), std::invalid_argument);
  try {
    process::mission_folder("no-such-mission");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no mission \"no-such-mission\": give a folder with a mission.yaml"));
  }
}

TEST_F(LaunchTest, TheSummaryIsCompletedAndAMissingOneIsAFailure) {
  Options options = parse({"--dds", "mixed", "--seed", "4"});
  options.run_folder = folder;
  auto summary = complete_summary(options, 1.5, true);
  EXPECT_FALSE(summary.good);
  EXPECT_THAT(summary.json, HasSubstr(R"("result":"failed")"));
  EXPECT_THAT(summary.json, HasSubstr(R"("seed":4)"));
  std::ofstream(folder / "summary.json") << R"({"result": "achieved", "goals": {"achieved": 3}, "sim_s": 7})";
  summary = complete_summary(options, 2.5, true);
  EXPECT_TRUE(summary.good);
  EXPECT_THAT(summary.json, HasSubstr(R"("dds":"mixed")"));
  EXPECT_THAT(summary.json, HasSubstr(R"("wall_s":2.5)"));
  EXPECT_THAT(summary.json, HasSubstr(R"("goals":{"achieved":3})"));
  EXPECT_THAT(summary.text, HasSubstr("3 achieved, 0 dropped, 0 failed\n"));
}

TEST_F(LaunchTest, TheSummaryTellsOfGoalsThatTheRunEndedWithout) {
  Options options = parse({});
  options.run_folder = folder;
  std::ofstream(folder / "summary.json")
      << R"({"result": "failed", "goals": {"achieved": 1, "rejected": 3, "open": 2}, "sim_s": 50})";
  EXPECT_THAT(complete_summary(options, 1, true).text,
              HasSubstr("1 achieved, 0 dropped, 0 failed, 3 rejected, 2 open\n"));
}

TEST_F(LaunchTest, AHostWithoutTheExecutiveServes) {
  Options options = parse({"--services", "planner_svc,arm_svc"});
  options.run_folder = folder;
  const Summary well = complete_summary(options, 1, true);
  EXPECT_TRUE(well.good);
  EXPECT_THAT(well.json, HasSubstr(R"("result":"served")"));
  EXPECT_THAT(well.text, HasSubstr("where exec_svc leads"));
  fs::remove(folder / "summary.json");
  EXPECT_FALSE(complete_summary(options, 1, false).good);
}

TEST_F(LaunchTest, AHostWithOneOfAPairServesIfTheOtherLedAtTheEnd) {
  Options options = parse({"--services", "exec_svc", "--standby", "--dds", "fastdds"});
  options.run_folder = folder;
  EXPECT_THAT(complete_summary(options, 1, true).json, HasSubstr(R"("result":"served")"));
  fs::remove(folder / "summary.json");
  EXPECT_FALSE(complete_summary(options, 1, false).good);
  fs::remove(folder / "summary.json");
  options.services.emplace_back("exec_svc.standby");
  EXPECT_FALSE(complete_summary(options, 1, true).good) << "one of the two leads";
  std::ofstream(folder / "summary.json") << R"({"result": "achieved", "goals": {"achieved": 3}, "sim_s": 7})";
  options.services.pop_back();
  EXPECT_THAT(complete_summary(options, 1, true).text, HasSubstr("3 achieved"));
}

TEST_F(LaunchTest, RunningMissionsAreFound) {
  process::RunRecord run;
  run.pid = getpid();
  run.domain = 5;
  run.mission = "/missions/x";
  run.peers = {"127.0.0.1"};
  run.pid_started = process::start_of_process(getpid());
  process::RunRecord dead = run, replaced = run;
  dead.pid = 1 << 30;    // beyond the largest process id
  replaced.pid = getppid();  // a process that is another one
  ASSERT_NE(process::start_of_process(replaced.pid), run.pid_started);
  {
    const process::PublishedRun published(folder, run);
    const process::PublishedRun of_the_dead(folder, dead), of_a_number_used_again(folder, replaced);
    std::ofstream(folder / "run-7.json") << "{ half a rec";
    EXPECT_THAT(process::find_runs(folder), ElementsAre(run));
  }
  EXPECT_TRUE(process::find_runs(folder).empty());
}

TEST_F(LaunchTest, ARecordThatAKilledLauncherLeftGoesWithTheNextRun) {
  fs::copy_file(ROCI_SOURCE_DIR "/tests/unit/services/golden/run-record-1.json", folder / "run-1.json");
  auto record = nlohmann::json::parse(std::ifstream(folder / "run-1.json"));
  record["pid"] = 1 << 30;
  std::ofstream(folder / "run-2.json") << record;
  record["pid"] = getppid();
  record["pid_started"] = 1;
  std::ofstream(folder / "run-3.json") << record;
  record.erase("pid_started");
  std::ofstream(folder / "run-4.json") << record;
  process::RunRecord run;
  run.pid = getpid();
  const process::PublishedRun published(folder, run);
  EXPECT_FALSE(fs::exists(folder / "run-2.json"));
  EXPECT_FALSE(fs::exists(folder / "run-3.json"));
  EXPECT_TRUE(fs::exists(folder / "run-4.json")) << "a process has its number, and it says no more";
}

TEST_F(LaunchTest, ARecordStatesItsFormatAndOneThatDoesNotIsOfTheFirst) {
  process::RunRecord run;
  run.pid = getpid();
  const process::PublishedRun published(folder, run);
  std::ifstream written(folder / ("run-" + std::to_string(getpid()) + ".json"));
  EXPECT_EQ(nlohmann::json::parse(written).at("format"), process::kRunRecordFormat);
  std::ifstream golden(ROCI_SOURCE_DIR
                       "/tests/unit/services/golden/run-record-1.json");  // baseline-05 wrote it
  auto record = nlohmann::json::parse(golden);
  ASSERT_FALSE(record.contains("format"));
  record["pid"] = getpid();
  std::ofstream(folder / "run-1.json") << record;
  const auto runs = process::find_runs(folder);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].scenario, "nominal");
  EXPECT_EQ(runs[0].domain, record["domain"]);
}

TEST_F(LaunchTest, ARecordOfANewerFormatIsRefusedInWords) {
  std::ofstream(folder / "run-1.json") << R"({"format": 2, "pid": )" << getpid() << "}";
  std::ofstream(folder / "run-2.json") << R"({"format": 2, "pid": 1073741824})";
  EXPECT_TRUE(process::find_runs(folder).empty());
  EXPECT_THAT(process::refused_runs(folder),
              ElementsAre(testing::AllOf(HasSubstr("run-1.json is of format 2"), HasSubstr("reads up to 1"),
                                         HasSubstr("use the programs"))));
}

TEST_F(LaunchTest, ASummaryStatesItsFormatAndANewerOneIsRefused) {
  Options options = parse({"--services", "exec_svc", "--dds", "fastdds"});
  options.run_folder = folder;
  EXPECT_THAT(complete_summary(options, 1, true).json, HasSubstr(R"("format":1)"));
  fs::remove(folder / "summary.json");
  fs::copy_file(ROCI_SOURCE_DIR "/tests/unit/services/golden/summary-1.json", folder / "summary.json");
  EXPECT_THAT(complete_summary(options, 1, true).text, HasSubstr("3 achieved"));
  std::ofstream(folder / "summary.json") << R"({"format": 2, "result": "achieved"})";
  try {
    complete_summary(options, 1, true);
    ADD_FAILURE() << "it was read";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("summary.json is of format 2"), HasSubstr("one version")));
  }
}

// A service that writes all the time goes on, and its log never has more than the limit and what was written meanwhile.
TEST_F(LaunchTest, ALogIsBoundedWhileItsServiceWrites) {
  const fs::path log = folder / "talker.log", before = folder / "talker.log.1";
  Child talker("/bin/sh", {"sh", "-c", "while true; do echo a line of some length; done"}, log);
  for (int times = 0; times < 3;) {
    times += bound_log(log, 100'000);
    ASSERT_LT(fs::file_size(log), 50'000'000U);
    ASSERT_FALSE(talker.ending());
  }
  EXPECT_GT(fs::file_size(before), 100'000U);
  std::ifstream in(before);
  std::string line;
  std::getline(in, line);
  std::getline(in, line);
  EXPECT_EQ(line, "a line of some length");
  EXPECT_FALSE(bound_log(folder / "nobody.log", 0));
  fs::create_symlink(before, folder / "link.log");
  EXPECT_FALSE(bound_log(folder / "link.log", 0)) << "a link leads to somebody else's file";
}

}  // namespace
}  // namespace roci::services::launch
