// Damaged journals, of every kind that a disk or a hand may make: each can be opened afterwards, what was damaged is
// kept beside it, and no goal that could be read is lost.
#include "exec_svc/journal/salvage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "exec_svc/journal/database_files.hpp"
#include "exec_svc/journal/format.hpp"
#include "exec_svc/journal/high_water_mark.hpp"
#include "exec_svc/journal/journaled_reactor.hpp"
#include "tests/unit/exec_svc/golden/golden.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"
#include "tests/unit/exec_svc/refused_writes.hpp"

namespace roci::exec {

using goals::GoalRecord;
using journal::damage_of;
using journal::DiskError;
using journal::Durability;
using journal::HighWaterMark;
using journal::Journal;
using journal::JournaledReactor;
using journal::kDamage;
using journal::NewerJournal;
using journal::salvage_if_damaged;
using mission::MissionModel;

namespace {

namespace fs = std::filesystem;
using temporal::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kPage = 4096;
constexpr int kGoals = 60;

class SalvageTest : public ::testing::Test {
 protected:
  SalvageTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    {
      Journal journal(file, Durability::process);
      for (int i = 0; i < kGoals; ++i) {
        GoalRecord record;
        record.request = testing::photo("goal-" + std::to_string(i));
        record.arrival = static_cast<std::uint64_t>(i) + 1;
        record.reason = std::string(100, 'r');  // so that they take several pages
        journal.put_goal(record);
      }
      for (int i = 0; i < 200; ++i) {
        journal.append_bytes(seconds(i), "input", std::string(200, static_cast<char>('a' + i % 20)));
        journal.append(seconds(i), "event", "event-" + std::to_string(i));
      }
      journal.set_number("epoch", 7);
      journal.set_number("plan_version", 3);
      journal.set_text("mission", "/missions/planetary");
      journal.commit();
    }
    std::ostringstream in;
    in << std::ifstream(file, std::ios::binary).rdbuf();
    whole = in.str();
  }
  ~SalvageTest() override { fs::remove_all(folder); }

  void write(const std::string& bytes) const {
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove(entry.path());
    std::ofstream(file, std::ios::binary) << bytes;
  }
  // Goals that are still there; each of them as it was.
  std::size_t goals_kept(const Journal& journal) const {
    std::size_t kept = 0;
    for (const GoalRecord& record : journal.goals()) {
      ++kept;
      EXPECT_EQ(record.request.kind, "photo");
      EXPECT_EQ(record.request.key.id, "goal-" + std::to_string(record.arrival - 1));
    }
    return kept;
  }
  // Whatever was done to the file: it is opened, and the damage is told exactly if there was one.
  std::size_t salvage(const std::string& bytes) const {
    write(bytes);
    const std::string damage = damage_of(file);
    salvage_if_damaged(file);
    const Journal journal(file, Durability::process);
    EXPECT_EQ(journal.text(kDamage).empty(), damage.empty()) << damage;
    EXPECT_EQ(fs::exists(fs::path(file).concat(".damaged-1")), !damage.empty());
    EXPECT_THAT(damage_of(file), IsEmpty());
    return goals_kept(journal);
  }

  const fs::path folder =
      fs::temp_directory_path() / ("roci_salvage_" + std::to_string(::getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file = folder / "journal.sqlite";
  std::string whole;
};

TEST_F(SalvageTest, AWholeJournalIsLeftAlone) {
  write(whole);
  salvage_if_damaged(file);
  const Journal journal(file, Durability::process);
  EXPECT_EQ(goals_kept(journal), kGoals);
  EXPECT_EQ(journal.number("epoch", 0), 7);
  EXPECT_THAT(journal.text(kDamage), IsEmpty());
  salvage_if_damaged(folder / "none.sqlite");
  EXPECT_FALSE(fs::exists(folder / "none.sqlite"));
}

TEST_F(SalvageTest, EveryTruncationIsSalvaged) {
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); size += kPage) {
    SCOPED_TRACE(size);
    const std::size_t kept = salvage(whole.substr(0, size));
    most = std::max(most, kept);
    salvage(whole.substr(0, size + kPage / 2));
  }
  EXPECT_EQ(most, kGoals) << "records stand behind the goals";
}

TEST_F(SalvageTest, AHeaderOfZeroesLosesNoGoal) {
  for (const std::size_t zeroes : {std::size_t{16}, std::size_t{100}, kPage}) {
    SCOPED_TRACE(zeroes);
    std::string damaged = whole;
    damaged.replace(0, zeroes, zeroes, '\0');
    EXPECT_EQ(salvage(damaged), kGoals);
    const Journal journal(file, Durability::process);
    EXPECT_EQ(journal.number("epoch", 0), 7);
    EXPECT_EQ(journal.number("plan_version", 0), 3);
    std::size_t events = 0;
    journal.for_each(
        [&](temporal::Time, std::string_view kind, std::string_view) { events += kind == "event"; });
    EXPECT_EQ(events, 201U) << "and the one that tells";
  }
}

TEST_F(SalvageTest, AnyDamageLeavesAJournalThatOpens) {
  std::mt19937_64 random(14);
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    std::string damaged = whole;
    const std::size_t pages = whole.size() / kPage;
    switch (round % 5) {
      case 0:
        for (int i = 0; i < 8; ++i)
          damaged[100 + below(damaged.size() - 100)] ^= static_cast<char>(1 + below(255));
        break;
      case 1:
        damaged.replace(below(pages) * kPage, kPage, kPage, '\0');
        break;
      case 2:
        for (std::size_t at = below(pages) * kPage, i = 0; i < kPage; ++i)
          damaged[at + i] = static_cast<char>(random());
        break;
      case 3:
        damaged.resize(below(damaged.size()));
        break;
      default:
        for (std::size_t at = 0; at < 100; ++at)
          if (below(4) == 0 && (at < 60 || at > 63)) damaged[at] = static_cast<char>(random());
    }
    EXPECT_LE(salvage(damaged), kGoals);
  }
}

TEST_F(SalvageTest, OneBadPageOfGoalsTakesNoOtherWithIt) {
  std::size_t worst = kGoals;
  for (std::size_t at = kPage; at < whole.size(); at += kPage) {
    SCOPED_TRACE(at / kPage);
    if (whole[at] != '\r' || whole.find("\"photo\"", at) > at + kPage) continue;  // no leaf with goals
    std::string damaged = whole;
    damaged.replace(at, kPage, kPage, '\0');
    worst = std::min(worst, salvage(damaged));
  }
  EXPECT_GE(worst, kGoals - 20U);
  EXPECT_LT(worst, kGoals) << "no page was found";
}

TEST_F(SalvageTest, AGoalThatSaysNothingIsLeftOutAlone) {
  write(whole);
  testing::execute(
      file,
      "UPDATE goal SET request = '{' WHERE id = 'goal-3'; UPDATE goal SET state = 77 WHERE id = 'goal-4'");
  EXPECT_THAT(damage_of(file), HasSubstr("goal-"));
  salvage_if_damaged(file);
  const Journal journal(file, Durability::process);
  EXPECT_EQ(goals_kept(journal), kGoals - 2);
  EXPECT_THAT(journal.text(kDamage), HasSubstr("58 goals, 2 could not"));
}

TEST_F(SalvageTest, AFileOfSomethingElseIsPutAside) {
  EXPECT_EQ(salvage("this is no database, and long enough to be looked at as one"), 0U);
  EXPECT_EQ(salvage(""), 0U);
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove(entry.path());
  testing::execute(file, "CREATE TABLE bookmark(url TEXT)");
  salvage_if_damaged(file);
  EXPECT_THAT(Journal(file, Durability::process).text(kDamage), HasSubstr("something else"));
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove(entry.path());
  fs::create_directory(file);
  salvage_if_damaged(file);
  EXPECT_THAT(Journal(file, Durability::process).text(kDamage), HasSubstr("it is no file"));
  fs::remove_all(fs::path(file).concat(".damaged-1"));
}

TEST_F(SalvageTest, ANewerJournalIsNoDamage) {
  write(whole);
  testing::execute(
      file, "PRAGMA user_version = 99; PRAGMA application_id = " + std::to_string(journal::stamp_of(99)));
  EXPECT_THROW(salvage_if_damaged(file), NewerJournal);
  EXPECT_FALSE(fs::exists(fs::path(file).concat(".damaged-1")));
}

// The version stands in two places: SQLite's user_version (bytes 60 to 63 of the file) and its application_id.
TEST_F(SalvageTest, AFlippedBitOfTheVersionIsNoNewerJournal) {
  for (std::size_t bit = 0; bit < 32; ++bit) {
    SCOPED_TRACE(bit);
    std::string damaged = whole;
    damaged[60 + bit / 8] = static_cast<char>(damaged[60 + bit / 8] ^ 1 << bit % 8);
    EXPECT_EQ(salvage(damaged), kGoals);
  }
}

TEST_F(SalvageTest, EachDamageIsKeptUnderANameOfItsOwn) {
  salvage(whole.substr(0, kPage));
  std::ofstream(file, std::ios::binary) << "again";
  journal::remove_database_logs(file);
  salvage_if_damaged(file);
  EXPECT_TRUE(fs::exists(fs::path(file).concat(".damaged-1")));
  EXPECT_TRUE(fs::exists(fs::path(file).concat(".damaged-2")));
}

// A row that says nothing must not outdo the mark, whose epoch counts where it is the later one.
TEST_F(SalvageTest, TheMarksEpochCountsWhereTheRowIsGarbageOrEarlier) {
  for (const auto& [row, epoch] :
       {std::pair<std::int64_t, std::int64_t>{std::int64_t{1} << 40, 12}, {-5, 12}, {11, 12}, {14, 14}}) {
    SCOPED_TRACE(row);
    write(whole);
    testing::execute(file, "UPDATE number SET value = " + std::to_string(row) +
                               " WHERE name = 'epoch'; UPDATE goal SET state = 77 WHERE id = 'goal-4'");
    HighWaterMark(file).write({.epoch = 12, .record = 1});
    salvage_if_damaged(file);
    EXPECT_EQ(Journal(file, Durability::process).number("epoch", 0), epoch);
  }
}

TEST_F(SalvageTest, ADiskThatDoesNotTakeTheNewJournalIsWaitedForAndTheOldOneStays) {
  const std::string damaged = std::string(100, '\0') + whole.substr(100);
  write(damaged);
  {
    const testing::RefusedWrites full(testing::checkpoints_of(fs::path(file).concat(".mended")));
    EXPECT_THROW(salvage_if_damaged(file), DiskError);
  }
  EXPECT_FALSE(fs::exists(fs::path(file).concat(".damaged-1")));
  salvage_if_damaged(file);
  EXPECT_EQ(goals_kept(Journal(file, Durability::process)), kGoals);
}

// The log and the mark go before the file that they belong to; a process may be killed between any two of these.
TEST_F(SalvageTest, AKillBetweenTheRenamesLosesNothing) {
  write(std::string(100, '\0') + whole.substr(100));
  HighWaterMark(file).write({.epoch = 12, .record = 1});
  salvage_if_damaged(file);
  const fs::path kept = fs::path(file).concat(".damaged-1"), ready = fs::path(file).concat(".salvaged");
  const auto expect_all = [&] {
    salvage_if_damaged(file);
    const Journal journal(file, Durability::process);
    EXPECT_EQ(goals_kept(journal), kGoals);
    EXPECT_EQ(journal.number("epoch", 0), 12);
    EXPECT_TRUE(fs::exists(kept));
    EXPECT_FALSE(fs::exists(ready));
    EXPECT_FALSE(fs::exists(fs::path(file).concat(".damaged-2")));
  };
  fs::rename(file, ready);
  expect_all();  // killed before the last rename
  fs::rename(file, ready);
  fs::rename(kept, file);
  fs::resize_file(file, kPage);  // nothing can be read of it any more
  expect_all();                  // killed before the one but last
}

// The executive knows its goals and that it knows no more; numbers of plans that may have run are not used again.
TEST_F(SalvageTest, AnExecutiveStartsInDoubt) {
  std::string damaged = whole;
  damaged.replace(0, 100, 100, '\0');
  salvage(damaged);
  Journal journal(file, Durability::process);
  const MissionModel mission = testing::planetary();
  const JournaledReactor executive(mission, journal, true);
  EXPECT_TRUE(executive.recovery().restarted);
  EXPECT_FALSE(executive.recovery().resumed);
  EXPECT_EQ(executive.reactor().goals().all().size(), static_cast<std::size_t>(kGoals));
  EXPECT_EQ(executive.reactor().plan_version(), 1003U);
  EXPECT_EQ(journal.next_epoch(), 8U);
}

}  // namespace
}  // namespace roci::exec
