#include "services/owner/command_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "services/owner/command_wire.hpp"
#include "tests/unit/core/durable/full_disk.hpp"
#include "tests/unit/services/owner/example_driver.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services::owner {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

v1::Command command(const std::string& activity, v1::CommandAction action = v1::COMMAND_EXECUTE,
                    const std::string& name = "bore", std::uint64_t epoch = 1, std::uint64_t issued = 1) {
  v1::Command out;
  out.activity(activity);
  out.attempt(1);
  out.action(action);
  out.owner("drill");
  out.subsystem("drill");
  out.command_name(name);
  out.epoch(issued);
  out.sender_epoch(epoch);
  out.latest_end_us(-1);
  return out;
}

v1::Command in_rock(v1::Command out, std::int64_t latest_end_us = -1) {
  out.latest_end_us(latest_end_us);
  v1::Property rock;
  rock.name("rock");
  rock.value("basalt");
  out.arguments().push_back(rock);
  return out;
}

// What the drill of the README says to these commands, each sent at its time: "<s> activity STAGE code".
std::vector<std::string> talk(const std::multimap<temporal::Duration, v1::Command>& commands,
                              const std::optional<v1::LeaseRequest>& lease = std::nullopt) {
  SimRun run({"master", "drill"});
  Node& master = run.add("master");
  const auto drill = example::make_drill(run.add("drill"));
  std::vector<std::string> heard;
  subscribe(master, topics::command_ack, [&](const v1::CommandAck& ack) {
    static const std::vector<std::string> stages{"accepted",  "rejected",      "completed", "failed",
                                                 "cancelled", "cancel-failed", "unknown"};
    EXPECT_EQ(ack.owner(), "drill");
    heard.push_back(std::to_string(master.now() / 1s) + " " + ack.activity() + " " + stages.at(ack.stage()) +
                    (ack.code().empty() ? "" : " " + ack.code()));
  });
  const auto sender = advertise(master, topics::command);
  const auto requests = advertise(master, topics::lease_request);
  bool granted = !lease;
  subscribe(master, topics::lease_state,
            [&](const v1::LeaseState& state) { granted = granted || state.member() == lease->member(); });
  master.on_turn([&] {
    if (!granted) requests.write(*lease);
  });
  for (const auto& [at, one] : commands) master.at(at, [&sender, one = one] { sender.write(one); });
  master.after(300s, [&master] { master.stop(); });
  run.run();
  return heard;
}

TEST(CommandServer, CarriesACommandOutOnce) {
  EXPECT_THAT(talk({{1s, command("a")}, {2s, command("a")}, {60s, command("a")}}),
              ElementsAre("1 a accepted", "2 a accepted", "41 a completed done", "60 a completed done"));
}

TEST(CommandServer, RejectsAndAnswersQueriesAndOldEpochs) {
  EXPECT_THAT(talk({{1s, command("a")},
                    {2s, command("b")},
                    {3s, command("c", v1::COMMAND_EXECUTE, "fly")},
                    {4s, command("a", v1::COMMAND_QUERY)},
                    {5s, command("d", v1::COMMAND_QUERY)},
                    {6s, command("a", v1::COMMAND_QUERY, "", 7)},
                    {7s, command("a", v1::COMMAND_QUERY, "", 6)},
                    {8s, command("a", v1::COMMAND_EXECUTE, "bore", 7, 7)},
                    {9s, command("a", v1::COMMAND_QUERY, "", 6)}}),
              ElementsAre("1 a accepted", "2 b rejected busy", "3 c rejected unknown-command", "4 a accepted",
                          "5 d unknown unknown-key", "6 a accepted", "7 a accepted", "8 a rejected busy",
                          "9 a rejected old-epoch", "41 a completed done"));
}

TEST(CommandServer, CancelsAndStops) {
  EXPECT_THAT(talk({{1s, command("a")},
                    {5s, command("a", v1::COMMAND_CANCEL)},
                    {6s, command("a", v1::COMMAND_CANCEL)},
                    {10s, command("b")},
                    {15s, command("s", v1::COMMAND_EXECUTE, "stop")}}),
              ElementsAre("1 a accepted", "5 a cancelled cancelled", "6 a cancel-failed already-ended",
                          "10 b accepted", "15 b cancelled stopped", "15 s completed done"));
}

TEST(CommandServer, LeadsAndIsStoppedByAnybody) {
  EXPECT_THAT(talk({{1s, command("epoch", v1::COMMAND_EXECUTE, "lead", 5, 5)},
                    {2s, command("a", v1::COMMAND_EXECUTE, "bore", 4, 4)},
                    {3s, command("a", v1::COMMAND_EXECUTE, "bore", 5, 5)},
                    {9s, command("s", v1::COMMAND_EXECUTE, "stop", 1, 1)},
                    {9s, command("s", v1::COMMAND_EXECUTE, "stop", 1, 1)}}),
              ElementsAre("1 epoch completed done", "2 a rejected old-epoch", "3 a accepted",
                          "9 a cancelled stopped", "9 s completed done", "9 s completed done"));
}

// Point for point what two leaders of one pair do after a partition: the same names, other epochs.
TEST(CommandServer, TwoLeadersOfOneNameNeverGetEachOthersAnswers) {
  EXPECT_THAT(talk({{1s, command("p2.1-bore", v1::COMMAND_EXECUTE, "bore", 1, 1)},
                    {50s, command("p2.1-bore", v1::COMMAND_EXECUTE, "bore", 2, 2)},
                    {51s, command("p2.1-bore", v1::COMMAND_EXECUTE, "bore", 1, 1)},
                    {52s, command("p2.1-bore", v1::COMMAND_QUERY, "bore", 2, 1)}}),
              ElementsAre("1 p2.1-bore accepted", "41 p2.1-bore completed done", "50 p2.1-bore accepted",
                          "51 p2.1-bore rejected old-epoch", "52 p2.1-bore completed done",
                          "90 p2.1-bore completed done"));
}

// Another process of this name holds the lease. The simulated clock outruns it: a term is wall time.
TEST(CommandServer, WithoutTheLeaseOneMayOnlyAskAndStop) {
  v1::LeaseRequest lease;
  lease.commander("master");
  lease.member("second");
  lease.epoch(2);
  lease.wanted(true);
  lease.term_us(60'000'000);
  EXPECT_THAT(talk({{101s, command("a", v1::COMMAND_EXECUTE, "bore", 3, 3)},
                    {102s, command("b", v1::COMMAND_EXECUTE, "bore", 2, 2)},
                    {103s, command("b", v1::COMMAND_CANCEL, "bore", 3, 2)},
                    {104s, command("b", v1::COMMAND_QUERY, "bore", 3, 2)},
                    {105s, command("fallback.1.1.drill", v1::COMMAND_EXECUTE, "bore", 3, 3)},
                    {106s, command("s", v1::COMMAND_EXECUTE, "stop", 3, 3)}},
                   lease),
              ElementsAre("101 a rejected not-leased", "102 b accepted", "103 b rejected not-leased",
                          "104 b accepted", "105 fallback.1.1.drill rejected not-leased",
                          "106 b cancelled stopped", "106 s completed done"));
}

TEST(CommandServer, LeavesTheCommandsOfOtherOwnersAlone) {
  v1::Command other = command("a");
  other.owner("sim_svc");
  EXPECT_THAT(talk({{1s, other}}), testing::IsEmpty());
}

// R146.
TEST(CommandServer, ARepairIsToldAndEndsAsASuccess) {
  EXPECT_THAT(talk({{1s, in_rock(command("a"))}}),
              ElementsAre("1 a accepted", "41 a accepted repairing", "81 a completed done"));
}

TEST(CommandServer, ARepairThatOverrunsItsStepFails) {
  EXPECT_THAT(talk({{1s, in_rock(command("a"), 60'000'000)}, {70s, command("b")}}),
              ElementsAre("1 a accepted", "41 a accepted repairing", "60 a failed repair-overrun",
                          "70 b accepted", "110 b completed done"));
}

TEST(CommandServer, AfterItsLatestEndNothingIsRepaired) {
  EXPECT_THAT(talk({{1s, in_rock(command("a"), 30'000'000)}}),
              ElementsAre("1 a accepted", "41 a failed jammed"));
}

TEST(CommandServer, TheKeyAndTheResultsGoOverTheWire) {
  v1::Command in = command("a");
  in.commander("exec_svc");
  in.epoch(3);
  in.sender_epoch(4);
  in.robot("scout");
  in.latest_end_us(7);
  const Request request = from_wire(in);
  EXPECT_EQ(request.key.commander, "exec_svc");
  EXPECT_EQ(request.key.issued_epoch, 3u);
  EXPECT_EQ(request.epoch, 4u);
  EXPECT_EQ(request.robot, "scout");
  EXPECT_EQ(request.latest_end, 7us);
  const Results results{3us, 2.5, {{"depth", 0.3}}};
  const v1::CommandAck out =
      to_wire({request.key, {Stage::completed, "done", "", results}, 9us, 4, true}, "drill");
  EXPECT_EQ(out.commander(), "exec_svc");
  EXPECT_EQ(out.epoch(), 3u);
  EXPECT_EQ(out.newest_epoch(), 4u);
  EXPECT_TRUE(out.refused_epoch());
  EXPECT_EQ(out.outcome().duration_us(), 3);
  EXPECT_EQ(out.outcome().energy_j(), 2.5);
  ASSERT_EQ(out.outcome().measured().size(), 1u);
  EXPECT_EQ(out.outcome().measured()[0].name(), "depth");
  EXPECT_EQ(out.outcome().measured()[0].held().number(), 0.3);
  const v1::CommandAck plain = to_wire({request.key, {Stage::accepted}, 9us}, "drill");
  EXPECT_EQ(plain.outcome().duration_us(), -1);
  EXPECT_TRUE(std::isnan(plain.outcome().energy_j()));
}

// A driver whose commands run for ever, and which repairs at once.
class Stubborn final : public Driver {
 public:
  explicit Stubborn(Node& node) : server(node, *this) {}
  void carry_out(const Request& request) override {
    server.say(request.key, {Stage::accepted});
    repaired = server.repair(request.key, "at once");
  }
  void break_off(const CommandKey& key, const CommandStatus& why) override {
    if (why.stage == Stage::cancelled) {
      server.refuse_cancel(key, "it never ends");
    } else {
      server.say(key, why);
    }
  }
  CommandServer server;
  bool repaired = false;
};

TEST(CommandServer, ACancelMayBeRefused) {
  SimRun run({"master", "drill"});
  Node& master = run.add("master");
  Stubborn driver(run.add("drill"));
  std::vector<std::string> heard;
  subscribe(master, topics::command_ack, [&](const v1::CommandAck& ack) { heard.push_back(ack.code()); });
  const auto sender = advertise(master, topics::command);
  master.at(1s, [&] { sender.write(command("a")); });
  master.at(2s, [&] { sender.write(command("a", v1::COMMAND_CANCEL)); });
  master.after(3s, [&master] { master.stop(); });
  run.run();
  EXPECT_TRUE(driver.repaired);
  EXPECT_THAT(heard, ElementsAre("", "repairing", "cannot-cancel"));
}

// What was done while the disk took nothing is kept once it takes something.
TEST(CommandServer, AFullDiskLosesNoKey) {
  const auto path = std::filesystem::temp_directory_path() / ("roci_full_" + std::to_string(::getpid()));
  std::filesystem::remove(path);
  std::optional<durable::FullDisk> full;
  std::vector<std::string> told;
  {
    SimRun run({"master", "drill"});
    Node& master = run.add("master");
    Stubborn driver(run.add("drill"));
    driver.server.keep_in(path);
    subscribe(master, topics::event, [&](const v1::Event& event) { told.push_back(event.code()); });
    const auto sender = advertise(master, topics::command);
    master.at(1s, [&] { full.emplace(std::filesystem::file_size(path)); });
    master.at(2s, [&] { sender.write(command("a")); });
    master.at(3s, [&] { full.reset(); });
    master.at(4s, [&] { sender.write(command("b")); });
    master.after(5s, [&master] { master.stop(); });
    run.run();
  }
  EXPECT_THAT(told, testing::Contains("ledger.unwritten"));
  std::vector<std::string> kept;
  for (const LedgerEntry& entry : LedgerFile(path).read()) kept.push_back(entry.key.activity);
  EXPECT_THAT(kept, ElementsAre("a", "b"));
  std::filesystem::remove(path);
}

// The README shows the code that the tests above ran.
TEST(CommandServer, TheReadmesExampleIsThisOne) {
  const auto text_of = [](const std::string& name) {
    std::ifstream in(std::filesystem::path(ROCI_SOURCE_DIR) / name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string source = text_of("tests/unit/services/owner/example_driver.cpp");
  const auto begin = source.find("class Drill");
  const std::string shown = source.substr(begin, source.find("};\n", begin) + 3 - begin);
  EXPECT_GT(shown.size(), 500u);
  EXPECT_THAT(text_of("services/owner/README.md"), HasSubstr(shown));
}

}  // namespace
}  // namespace roci::services::owner
