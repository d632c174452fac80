// A disk that takes nothing for a while, and steps that end halfway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>

#include "exec_svc/journal/database_files.hpp"
#include "exec_svc/journal/journal.hpp"
#include "tests/unit/core/durable/full_disk.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"
#include "tests/unit/exec_svc/refused_writes.hpp"

namespace roci::exec {

using durable::FullDisk;
using journal::DiskError;
using journal::Durability;
using journal::Journal;

namespace {

namespace fs = std::filesystem;
using temporal::seconds;

class JournalDisk : public ::testing::Test {
 protected:
  ~JournalDisk() override { journal::remove_database(file); }

  static std::vector<std::string> records(const Journal& journal) {
    std::vector<std::string> out;
    journal.for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
      out.push_back(std::string(kind) + " " + std::string(text.substr(0, 8)));
    });
    return out;
  }
  static void put(Journal& journal, const std::string& id) {
    goals::GoalRecord record;
    record.request = testing::photo(id);
    journal.put_goal(record);
  }

  fs::path file = fs::temp_directory_path() /
                  ("roci_disk_" + std::to_string(::getpid()) + "_" +
                   ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".sqlite");
};

TEST_F(JournalDisk, WhatAFullDiskDidNotTakeIsWrittenByTheNextCommit) {
  {
    Journal journal(file, Durability::power);
    journal.append(seconds(1), "event", "before");
    journal.commit();
    const FullDisk full(4096);
    put(journal, "ridge");
    const std::int64_t first = journal.append_bytes(seconds(2), "input", std::string(100'000, 'x'));
    const std::int64_t second = journal.append_bytes(seconds(2), "anchor", "after");
    EXPECT_EQ(second, first + 1);
    EXPECT_THROW(journal.commit(), DiskError);
    EXPECT_THROW(journal.commit(), DiskError);
    full.end();
    journal.set_number("anchor", second);
    journal.commit();
  }
  const Journal journal(file, Durability::power);
  EXPECT_THAT(records(journal), ::testing::ElementsAre("event before", "input xxxxxxxx", "anchor after"));
  EXPECT_EQ(journal.goals().size(), 1U);
  std::vector<std::string> from_anchor;
  journal.for_each_from(
      journal.number("anchor", 0),
      [&](temporal::Time, std::string_view, std::string_view text) { from_anchor.emplace_back(text); });
  EXPECT_THAT(from_anchor, ::testing::ElementsAre("after"));
}

TEST_F(JournalDisk, ACommitWaitsUntilTheDiskTakesItAndSaysSoOnce) {
  Journal journal(file, Durability::process);
  const FullDisk full(4096);
  int waits = 0, overs = 0;
  std::string cause;
  journal.wait_for_disk({[&](const std::string& why) {
                           cause = why;
                           if (++waits == 3) full.end();
                         },
                         [&] { ++overs; }});
  journal.append_bytes(seconds(2), "input", std::string(100'000, 'x'));
  journal.commit();
  EXPECT_EQ(waits, 3);
  EXPECT_EQ(overs, 1);
  EXPECT_THAT(cause, ::testing::AnyOf(::testing::HasSubstr("disk I/O error"), ::testing::HasSubstr("full")));
  EXPECT_EQ(records(journal).size(), 1U);
}

TEST_F(JournalDisk, ABatchForTheFollowerIsMadeOnceAndOnlyOfWhatWasWritten) {
  Journal journal(file, Durability::process);
  journal.begin_epoch(1);
  journal.take_batches();
  const FullDisk full(4096);
  journal.append_bytes(seconds(2), "input", std::string(100'000, 'x'));
  EXPECT_THROW(journal.commit(), DiskError);
  EXPECT_TRUE(journal.take_batches().empty());
  full.end();
  journal.commit();
  const auto batches = journal.take_batches();
  ASSERT_EQ(batches.size(), 1U);
  const fs::path copied = fs::path(file).concat(".copy");
  {
    Journal copy(copied, Durability::process);
    copy.replace_with(journal.serialized());
    EXPECT_EQ(copy.position(), batches[0].at);
    EXPECT_EQ(records(copy), records(journal));
  }
  journal::remove_database(copied);
}

TEST_F(JournalDisk, AWholeJournalThatTheDiskDoesNotTakeReplacesNothing) {
  const fs::path leaders = fs::path(file).concat(".leader"), arrived = fs::path(file).concat(".arrived");
  Journal leader(leaders, Durability::process), journal(file, Durability::process);
  leader.append_bytes(seconds(1), "input", std::string(100'000, 'x'));
  leader.commit();
  put(journal, "ridge");
  journal.commit();
  {
    const FullDisk full(70'000);
    EXPECT_THROW(journal.replace_with(leader.serialized()), DiskError);
  }
  {
    const testing::RefusedWrites full(
        [&](const fs::path& one) { return one.string().starts_with(arrived.string()); });
    EXPECT_THROW(journal.replace_with(leader.serialized()), DiskError);
  }
  EXPECT_FALSE(fs::exists(arrived)) << "it would take up room";
  EXPECT_EQ(journal.goals().size(), 1U);
  journal.replace_with(leader.serialized());
  EXPECT_TRUE(journal.goals().empty());
  journal::remove_database(leaders);
}

// Between both files this process has no journal: it ends, and whoever starts anew finds the leader's.
TEST_F(JournalDisk, AReplacementThatCannotBeOpenedYetIsThereForTheNextStart) {
  const fs::path leaders = fs::path(file).concat(".leader");
  Journal leader(leaders, Durability::process);
  put(leader, "valley");
  leader.commit();
  {
    Journal journal(file, Durability::process);
    put(journal, "ridge");
    journal.commit();
    const testing::RefusedWrites full([&](const fs::path& one) {
      return one == fs::path(file).concat("-shm") && !fs::exists(fs::path(file).concat(".arrived"));
    });
    try {
      journal.replace_with(leader.serialized());
      FAIL() << "it was opened";
    } catch (const journal::JournalError&) {
      FAIL() << "that is for what has changed nothing";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("cannot be opened yet"));
    }
  }
  const auto goals = Journal(file, Durability::process).goals();
  ASSERT_EQ(goals.size(), 1U);
  EXPECT_EQ(goals[0].request.key.id, "valley");
  journal::remove_database(leaders);
}

TEST_F(JournalDisk, AStepThatAnExceptionCutsOffIsNotDurable) {
  try {
    Journal journal(file, Durability::power);
    put(journal, "ridge");
    journal.commit();
    put(journal, "valley");
    throw std::runtime_error("a handler failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(Journal(file, Durability::power).goals().size(), 1U);
}

TEST_F(JournalDisk, AReaderThatHoldsTheFileIsWaitedForAndNotAnError) {
  Journal journal(file, Durability::process);
  sqlite3* other = nullptr;
  sqlite3_open(file.c_str(), &other);
  sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr);
  int waits = 0;
  journal.wait_for_disk({[&](const std::string&) {
                           ++waits;
                           sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
                         },
                         nullptr});
  put(journal, "ridge");
  journal.commit();
  EXPECT_EQ(waits, 1);
  sqlite3_close(other);
  EXPECT_EQ(journal.goals().size(), 1U);
}

}  // namespace
}  // namespace roci::exec
