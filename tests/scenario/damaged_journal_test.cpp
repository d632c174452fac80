// The programs that users start, on journals that a disk has damaged: exec_svc starts, keeps the goals that can be read
// and tells the ground, whatever was done to the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "exec_svc/journal/high_water_mark.hpp"
#include "exec_svc/journal/journal.hpp"
#include "exec_svc/journal/salvage.hpp"
#include "exec_svc/standby/persisted_term_file.hpp"
#include "tests/fuzz/rounds.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using exec::goals::GoalRecord;
using exec::journal::Durability;
using exec::journal::Journal;

constexpr std::size_t kPage = 4096;
constexpr int kGoals = 40;

class DamagedJournal : public ::testing::Test {
 protected:
  DamagedJournal() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    {
      Journal journal(folder / "whole.sqlite", Durability::process);
      for (int i = 0; i < kGoals; ++i) {
        GoalRecord record;
        record.request.key = {"ground", "goal-" + std::to_string(i)};
        record.request.kind = "photo";
        record.request.arguments = {{"x", "110"}, {"y", "60"}};
        record.state = exec::goals::GoalState::recalled;
        record.arrival = static_cast<std::uint64_t>(i) + 1;
        record.reason = std::string(100, 'r');
        journal.put_goal(record);
      }
      for (int i = 0; i < 100; ++i)
        journal.append_bytes(temporal::seconds(i), "input",
                             std::string(200, static_cast<char>('a' + i % 20)));
      journal.set_number("epoch", 7);
      journal.commit();
    }
    std::ostringstream in;
    in << std::ifstream(folder / "whole.sqlite", std::ios::binary).rdbuf();
    whole = in.str();
  }
  ~DamagedJournal() override { fs::remove_all(folder); }

  fs::path run_folder(std::size_t number) const { return folder / std::to_string(number); }

  // Starts exec_svc on each of them, several at once, and ends it after a while with SIGTERM. A file with its exit code
  // stands in each run folder then.
  void start_on(const std::vector<std::string>& journals, const std::string& options = "") const {
    std::string script = "cd " + folder.string() + "; ";
    for (std::size_t i = 0; i < journals.size(); ++i) {
      fs::create_directories(run_folder(i));
      std::ofstream(run_folder(i) / "journal.sqlite", std::ios::binary) << journals[i];
      // Alone in a run of its own: no other service is there.
      script += "(timeout --preserve-status -k 20 4 exec_svc --mission " ROCI_SOURCE_DIR
                "/missions/planetary --clock live --epoch $(date +%s) --robot rover --dds cyclonedds --run "
                "damaged-" +
                std::to_string(::getpid()) + "-" + std::to_string(i) + " --domain " +
                std::to_string(101 + i % 100) + " --run-folder " + run_folder(i).string() + " " + options + " > " +
                (run_folder(i) / "log").string() + " 2>&1; echo $? > " + (run_folder(i) / "code").string() +
                ") & ";
      if (i % 6 == 5) script += "wait; ";
    }
    run(script + "wait");
  }
  std::string content(std::size_t number, const char* name) const {
    std::ostringstream out;
    out << std::ifstream(run_folder(number) / name).rdbuf();
    return out.str();
  }
  // Returns how many goals it knows, and expects that it ran and told.
  std::size_t goals_after(std::size_t number, bool damaged) const {
    EXPECT_EQ(content(number, "code"), "0\n") << content(number, "log");
    EXPECT_EQ(fs::exists(run_folder(number) / "journal.sqlite.damaged-1"), damaged);
    EXPECT_EQ(content(number, "log").find("journal.sqlite was damaged") != std::string::npos, damaged);
    const Journal journal(run_folder(number) / "journal.sqlite", Durability::process);
    EXPECT_GE(journal.number("epoch", 0), 1);
    return journal.goals().size();
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_damaged_" + std::to_string(::getpid()));
  std::string whole;
};

std::string with_zeroes(std::string bytes, std::size_t at, std::size_t count) {
  return bytes.replace(at, count, count, '\0');
}

TEST_F(DamagedJournal, TheExecutiveStartsAndKeepsWhatCanBeRead) {
  fs::create_directories(run_folder(3));
  exec::journal::HighWaterMark(run_folder(3) / "journal.sqlite").write({.epoch = 7, .record = 100});
  start_on({whole, whole.substr(0, whole.size() - kPage), with_zeroes(whole, 0, 100), "no database at all"});
  EXPECT_EQ(goals_after(0, false), kGoals);
  EXPECT_EQ(goals_after(1, true), kGoals);
  EXPECT_EQ(goals_after(2, true), kGoals);
  EXPECT_EQ(goals_after(3, true), 0U);
  for (const std::size_t number : {2U, 3U})
    EXPECT_GT(Journal(run_folder(number) / "journal.sqlite", Durability::process).number("epoch", 0), 7)
        << "no epoch is used twice: the journal says it, or the mark beside one that says nothing";
}

// One flipped bit of the stated version is damage, and no newer version that nobody may start on.
TEST_F(DamagedJournal, AFlippedBitOfTheVersionKeepsNobodyFromStarting) {
  std::string high = whole, low = whole;
  high[60] = static_cast<char>(high[60] ^ 0x40);
  low[63] = static_cast<char>(low[63] ^ 0x04);
  start_on({high, low});
  for (const std::size_t number : {0U, 1U}) EXPECT_EQ(goals_after(number, true), kGoals);
}

// A changed digit of a pair's term would be another term, that may lead, in epochs that were used before.
TEST_F(DamagedJournal, AFlippedDigitOfTheTermPutsTheMemberOfAPairInDoubt) {
  fs::create_directories(run_folder(0));
  const fs::path standing = run_folder(0) / "standing";
  exec::standby::PersistedTermFile(standing, Durability::process).keep({7, false, 6});
  std::string term = content(0, "standing");
  ASSERT_EQ(term.front(), '7');
  std::ofstream(standing) << term.replace(0, 1, "3");
  start_on({whole}, "--pair first");
  EXPECT_EQ(content(0, "code"), "0\n");
  EXPECT_NE(content(0, "log").find("standing is damaged"), std::string::npos) << content(0, "log");
  EXPECT_EQ(content(0, "standing.damaged-1"), term);
  EXPECT_GE(exec::standby::PersistedTermFile(standing, Durability::process).read().epoch, 100U);
}

// The newest commits are gone, and only the mark beside the journal knows: nothing goes on as if they had not been.
TEST_F(DamagedJournal, ALostEndIsNoticedAndTold) {
  fs::create_directories(run_folder(0));
  {
    Journal journal(folder / "whole.sqlite", Durability::process);
    EXPECT_EQ(journal.watch_extent(), "");
    journal.set_number("epoch", 12);
    journal.append(temporal::seconds(200), "event", "the last one");
    journal.commit();
  }
  fs::copy_file(folder / "whole.sqlite-mark", run_folder(0) / "journal.sqlite-mark");
  start_on({whole});
  EXPECT_EQ(goals_after(0, false), kGoals);
  EXPECT_NE(content(0, "log").find("journal.sqlite has lost its end"), std::string::npos)
      << content(0, "log");
  EXPECT_EQ(Journal(run_folder(0) / "journal.sqlite", Durability::process).number("epoch", 0), 13);
}

// Of 96 damages none keeps the executive from starting (./check --full; in ./check of the first few).
TEST_F(DamagedJournal, NoDamageKeepsTheExecutiveFromStarting) {
  std::mt19937_64 random(1414);
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  std::vector<std::string> journals;
  const std::size_t pages = whole.size() / kPage;
  for (std::size_t size = 0; size < whole.size() && journals.size() < 40; size += kPage)
    journals.push_back(whole.substr(0, size));
  while (journals.size() < 96) {
    std::string damaged = whole;
    switch (journals.size() % 3) {
      case 0:
        for (int i = 0; i < 8; ++i)
          damaged[100 + below(damaged.size() - 100)] ^= static_cast<char>(1 + below(255));
        break;
      case 1:
        damaged = with_zeroes(whole, below(pages) * kPage, kPage);
        break;
      default:
        damaged.resize(below(damaged.size()));
    }
    journals.push_back(std::move(damaged));
  }
  std::ranges::shuffle(journals, random);
  journals.resize(std::min<std::size_t>(journals.size(), static_cast<std::size_t>(fuzz::rounds(5))));
  start_on(journals);
  for (std::size_t i = 0; i < journals.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_LE(goals_after(i, fs::exists(run_folder(i) / "journal.sqlite.damaged-1")), kGoals);
  }
}

}  // namespace
}  // namespace roci::scenario
