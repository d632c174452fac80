// A run again from its journal: the same trace, also across restarts and forgotten inputs; and what is told
// when the code or the mission is another.
#include "exec_svc/journal/run_replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/exec_svc/crash_world.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec::testing {

using journal::Durability;
using journal::Journal;
using journal::RunReplay;
using mission::MissionModel;

namespace {

using ::testing::StartsWith;

class RunReplayTest : public ::testing::Test {
 protected:
  RunReplay flown(const CrashPlan& crash, const MissionModel& mission = planetary()) {
    CrashWorld world(crash);
    world.send(10, photo("first"));
    world.send(30, photo("second"));
    trace = world.fly(600).trace_sha256;
    return replay_run(Journal(world.file()), mission);
  }
  std::string trace;
};

TEST_F(RunReplayTest, ComesToTheSameTrace) {
  const RunReplay run = flown({});
  EXPECT_FALSE(run.divergence);
  EXPECT_GT(run.decisions, 20U);
  EXPECT_EQ(run.replayed_sha256, trace);
  EXPECT_EQ(run.trace_sha256, trace);
}

TEST_F(RunReplayTest, ComesToTheSameTraceAcrossRestarts) {
  const RunReplay run = flown({{5, 8, 12}, Moment::after_write_ahead});
  EXPECT_FALSE(run.divergence);
  EXPECT_EQ(run.restarts, 3U);
  EXPECT_EQ(run.replayed_sha256, trace);
}

TEST_F(RunReplayTest, BeginsAtTheAnchorWhereInputsWereForgotten) {
  const RunReplay run = flown({{9}, Moment::after_send, temporal::Duration{0}, true});
  EXPECT_FALSE(run.divergence);
  EXPECT_GT(run.from, temporal::seconds(29));
  EXPECT_EQ(run.replayed_sha256, trace);
}

TEST_F(RunReplayTest, TextsAreForgottenButForTheNewest) {
  CrashPlan crash{{9}, Moment::after_send, temporal::Duration{0}, true};
  crash.kept_records = 5;
  CrashWorld world(crash);
  world.send(10, photo("first"));
  world.send(30, photo("second"));
  const Flight flight = world.fly(600);
  EXPECT_EQ(flight.not_resumed, 0U);
  EXPECT_EQ(flight.outcome, "achieved");
  const Journal journal(world.file(), Durability::process);
  const RunReplay run = replay_run(journal, planetary());
  EXPECT_FALSE(run.divergence) << "from the newest anchor on, all is there";
  EXPECT_GT(run.turns, 0U);
  std::size_t before = 0;
  bool anchored = false;
  journal.for_each([&](temporal::Time, std::string_view kind, std::string_view) {
    anchored = anchored || kind == "anchor" || kind == "restored";
    before += !anchored;
  });
  EXPECT_TRUE(anchored);
  EXPECT_LE(before, 5U);
  EXPECT_EQ(journal.goals().size(), 2U) << "goals are never forgotten";
}

// Whoever repeats a run by mistake from another program's database finds that database as it was.
TEST(ReadJournal, WhatIsNoJournalIsRefusedAndStaysAsItIs) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("roci_no_journal_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto content_of = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto refused = [&](const std::string& content) {
    const auto file = folder / "given";
    std::ofstream(file, std::ios::binary) << content;
    EXPECT_THROW(Journal{file}, journal::JournalError);
    EXPECT_EQ(content_of(file), content);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  };
  refused("");
  refused("x");
  refused("no database of any kind");
  const auto other = folder / "other";
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(other.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(
      sqlite3_exec(database, "CREATE TABLE mine(a); INSERT INTO mine VALUES(1)", nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(database);
  const std::string content = content_of(other);
  fs::remove(other);
  refused(content);
  fs::remove_all(folder);
}

TEST_F(RunReplayTest, TellsWhereOtherRulesDecideOtherwise) {
  MissionModel other = planetary();
  other.planner.allowance = temporal::seconds(9);
  const RunReplay run = flown({}, other);
  ASSERT_TRUE(run.divergence);
  EXPECT_EQ(run.divergence->time, temporal::seconds(10));
  EXPECT_THAT(run.divergence->expected, StartsWith("call: "));
  EXPECT_THAT(run.divergence->got, StartsWith("call: "));
  EXPECT_NE(run.divergence->got, run.divergence->expected);
  EXPECT_NE(run.replayed_sha256, trace);
}

}  // namespace
}  // namespace roci::exec::testing
