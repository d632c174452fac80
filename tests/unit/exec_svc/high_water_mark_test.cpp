// A write-ahead log that has lost its end: SQLite says nothing, the mark beside the journal does.
#include "exec_svc/journal/high_water_mark.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "exec_svc/journal/journaled_reactor.hpp"
#include "exec_svc/journal/salvage.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {

using goals::GoalRecord;
using journal::Durability;
using journal::Extent;
using journal::HighWaterMark;
using journal::Journal;
using journal::JournaledReactor;
using journal::kShortened;

namespace {

namespace fs = std::filesystem;
using temporal::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kCommits = 12;

class HighWaterMarkTest : public ::testing::Test {
 protected:
  HighWaterMarkTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    { const Journal empty(folder / "flown.sqlite", Durability::process); }  // its tables are in the database
    Journal journal(folder / "flown.sqlite", Durability::process);
    EXPECT_THAT(journal.watch_extent(), IsEmpty());
    for (int i = 0; i < kCommits; ++i) {
      GoalRecord record;
      record.request = testing::photo("goal-" + std::to_string(i));
      record.arrival = static_cast<std::uint64_t>(i) + 1;
      journal.put_goal(record);
      journal.append(seconds(i), "event", "event-" + std::to_string(i));
      if (i == kCommits / 2) journal.set_number("epoch", 5);
      journal.commit();
    }
    // As a process leaves them that is killed here: most stands in the write-ahead log alone.
    database = read(folder / "flown.sqlite");
    log = read(folder / "flown.sqlite-wal");
    mark = read(folder / "flown.sqlite-mark");
  }
  ~HighWaterMarkTest() override { fs::remove_all(folder); }

  static std::string read(const fs::path& path) {
    std::ostringstream in;
    in << std::ifstream(path, std::ios::binary).rdbuf();
    return in.str();
  }
  void write(const std::string& with_log, const std::string& with_mark) const {
    for (const char* suffix : {"", "-wal", "-shm", "-mark"}) fs::remove(fs::path(file).concat(suffix));
    std::ofstream(file, std::ios::binary) << database;
    std::ofstream(fs::path(file).concat("-wal"), std::ios::binary) << with_log;
    if (!with_mark.empty()) std::ofstream(fs::path(file).concat("-mark"), std::ios::binary) << with_mark;
  }
  // What the next start says, having checked that it says so exactly when a goal is gone.
  std::string start() const {
    EXPECT_THAT(journal::damage_of(file), IsEmpty());
    Journal journal(file, Durability::process);
    const std::string lost = journal.watch_extent();
    EXPECT_EQ(journal.goals().size() < static_cast<std::size_t>(kCommits), !lost.empty());
    EXPECT_EQ(journal.text(kShortened), lost);
    EXPECT_TRUE(lost.empty() || journal.position() == journal::kForkedHistory);
    EXPECT_GE(journal.number("epoch", 0), 5) << "as the lost end may have said";
    return lost;
  }

  const fs::path folder =
      fs::temp_directory_path() / ("roci_mark_" + std::to_string(::getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file = folder / "journal.sqlite";
  std::string database, log, mark;
};

TEST_F(HighWaterMarkTest, WhatIsWholeIsNotSpokenOf) {
  write(log, mark);
  EXPECT_THAT(start(), IsEmpty());
  EXPECT_THAT(start(), IsEmpty());
}

TEST_F(HighWaterMarkTest, ALogThatIsCutAnywhereIsNoticed) {
  constexpr std::size_t kHeader = 32, kFrame = 24 + 4096;
  int noticed = 0;
  for (std::size_t size = kHeader; size < log.size(); size += kFrame) {
    SCOPED_TRACE(size);
    write(log.substr(0, size), mark);
    noticed += start().empty() ? 0 : 1;
    write(log.substr(0, size + kFrame / 2), mark);
    start();
  }
  EXPECT_GE(noticed, kCommits);
}

TEST_F(HighWaterMarkTest, AFlippedByteOfTheLogIsNoticed) {
  std::string damaged = log;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x20);
  write(damaged, mark);
  EXPECT_THAT(start(), HasSubstr("has lost its end: it was written up to record 12 in epoch 5"));
  EXPECT_THAT(Journal(file, Durability::process).watch_extent(), IsEmpty()) << "the mark is of what there is";
}

TEST_F(HighWaterMarkTest, WithoutAMarkNothingIsKnown) {
  for (const std::string& none : {std::string(), mark.substr(0, 30), "x" + mark.substr(1)}) {
    write(log.substr(0, 32), none);
    EXPECT_THAT(Journal(file, Durability::process).watch_extent(), IsEmpty());
  }
}

TEST_F(HighWaterMarkTest, AJournalThatCameFromElsewhereHasAMarkOfItsOwn) {
  write(log, mark);
  const fs::path shorter = folder / "shorter.sqlite";
  std::string arrived;
  {
    Journal other(shorter, Durability::process);
    other.append(seconds(1), "event", "one");
    other.commit();
    arrived = other.serialized();
  }
  {
    Journal journal(file, Durability::process);
    EXPECT_THAT(journal.watch_extent(), IsEmpty());
    journal.replace_with(arrived);
    EXPECT_EQ(HighWaterMark(file).read(), (Extent{.epoch = 0, .record = 1}));
  }
  EXPECT_THAT(Journal(file, Durability::process).watch_extent(), IsEmpty());
}

// The goals that are left count; what was commanded since is not known, so that all is planned anew in a later epoch.
TEST_F(HighWaterMarkTest, AnExecutiveStartsInDoubt) {
  write(log.substr(0, log.size() / 2), mark);
  EXPECT_THAT(start(), HasSubstr("send again"));
  Journal journal(file, Durability::process);
  const mission::MissionModel mission = testing::planetary();
  const JournaledReactor executive(mission, journal, !journal.text(kShortened).empty());
  EXPECT_FALSE(executive.recovery().resumed);
  EXPECT_GT(executive.reactor().plan_version(), 900U);
  EXPECT_EQ(journal.next_epoch(), 6U);
}

}  // namespace
}  // namespace roci::exec
