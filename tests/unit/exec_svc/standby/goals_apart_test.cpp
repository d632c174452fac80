// Goals of a journal that is replaced: on full disks and damaged ones none of them goes unread.
#include "exec_svc/standby/goals_apart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "exec_svc/standby/journal_copy.hpp"
#include "tests/unit/exec_svc/refused_writes.hpp"

namespace roci::exec::standby {
namespace {

namespace fs = std::filesystem;
using journal::DiskError;
using journal::Durability;
using journal::Journal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GoalsApartTest : public ::testing::Test {
 protected:
  GoalsApartTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~GoalsApartTest() override { fs::remove_all(folder); }

  static void put(Journal& journal, const std::string& id) {
    goals::GoalRecord record;
    record.request.key = {"ground", id};
    record.request.kind = "photo";
    journal.put_goal(record);
    journal.commit();
  }
  // Keeps a goal as that of a journal that is replaced.
  void keep(const std::string& id) {
    Journal journal(folder / (id + ".sqlite"), Durability::process);
    put(journal, id);
    apart.keep(journal);
  }
  static std::vector<std::string> ids(const std::vector<goals::GoalRecord>& goals) {
    std::vector<std::string> out;
    for (const auto& goal : goals) out.push_back(goal.request.key.id);
    return out;
  }

  const fs::path folder =
      fs::temp_directory_path() / ("roci_apart_" + std::to_string(::getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file = folder / "journal.sqlite", first = folder / "journal.sqlite.apart-1",
                 second = folder / "journal.sqlite.apart-2";
  GoalsApart apart{file, Durability::process};
};

TEST_F(GoalsApartTest, WhatWasReadIsRemovedAndNothingElse) {
  keep("ridge");
  EXPECT_THAT(ids(apart.goals()), ElementsAre("ridge"));
  keep("valley");
  apart.remove();
  EXPECT_FALSE(fs::exists(first));
  EXPECT_TRUE(fs::exists(second)) << "nobody has read it";
  EXPECT_THAT(ids(GoalsApart(file, Durability::process).goals()), ElementsAre("valley"));
}

TEST_F(GoalsApartTest, ADiskThatDoesNotTakeAllOfThemKeepsTheJournalThatHasThem) {
  Journal journal(file, Durability::process), leaders(folder / "leader.sqlite", Durability::process);
  put(journal, "ridge");
  leaders.begin_epoch(2);
  put(leaders, "valley");
  JournalCopy copy(journal, [&] { apart.keep(journal); });
  const std::string whole = leaders.serialized();
  Chunk chunk{2, {}, leaders.position(), 0, 1, 0, whole};
  chunk.checksum = checksum(chunk);
  {
    const testing::RefusedWrites full(testing::checkpoints_of(fs::path(first).concat(".new")));
    EXPECT_THROW(apart.keep(journal), DiskError);
    EXPECT_EQ(copy.take(chunk, 0), JournalCopy::Result::unwritten);
  }
  EXPECT_FALSE(fs::exists(first));
  EXPECT_THAT(ids(journal.goals()), ElementsAre("ridge"));
  EXPECT_EQ(copy.take(chunk, 0), JournalCopy::Result::whole);
  EXPECT_THAT(ids(journal.goals()), ElementsAre("valley"));
  EXPECT_THAT(ids(apart.goals()), ElementsAre("ridge"));
}

TEST_F(GoalsApartTest, AFileThatTheDiskDoesNotLetBeReadStaysAndIsReadLater) {
  keep("ridge");
  {
    const testing::RefusedWrites full(
        [](const fs::path& written) { return written.string().ends_with("-shm"); });
    EXPECT_THAT(apart.goals(), IsEmpty());
  }
  EXPECT_TRUE(apart.waits_for_disk());
  EXPECT_THAT(apart.take_damage(), IsEmpty());
  apart.remove();
  EXPECT_THAT(ids(apart.goals()), ElementsAre("ridge"));
  EXPECT_FALSE(apart.waits_for_disk());
}

TEST_F(GoalsApartTest, ADamagedFileIsKeptAndTold) {
  keep("ridge");
  keep("valley");
  std::ofstream(first, std::ios::binary) << "no database at all";
  EXPECT_THAT(ids(apart.goals()), ElementsAre("valley"));
  EXPECT_THAT(apart.take_damage(), ElementsAre(HasSubstr("journal.sqlite.apart-1 was damaged")));
  apart.goals();
  EXPECT_THAT(apart.take_damage(), IsEmpty()) << "told once";
  apart.remove();
  EXPECT_TRUE(fs::exists(fs::path(first).concat(".damaged-1")));
  EXPECT_THAT(apart.goals(), IsEmpty());
}

}  // namespace
}  // namespace roci::exec::standby
