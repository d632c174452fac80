#include "exec_svc/journal/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "exec_svc/journal/trace.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {

using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalState;
using journal::Durability;
using journal::Journal;
using journal::JournalError;
using journal::Trace;

namespace {

using temporal::seconds;

class JournalTest : public ::testing::Test {
 protected:
  JournalTest() {
    file = std::filesystem::temp_directory_path() /
           (std::string("roci_journal_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
            ".sqlite");
    remove();
  }
  ~JournalTest() override { remove(); }
  void remove() const {
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + suffix);
  }
  std::filesystem::path file;
};

TEST_F(JournalTest, GoalsComeBackAsTheyWere) {
  GoalRecord record;
  record.request = testing::photo("ridge", GoalClass::optional, 2.5);
  record.request.opens = seconds(10);
  record.request.priority = -3;
  record.state = GoalState::dropped;
  record.reason = "it's 100 % \"full\"";
  record.arrival = 7;
  record.plan_version = 3;
  record.request.sample = {"roci-7", 0, 1};
  record.answers = {"roci-8", 2, 1ULL << 40};
  record.before = {{"sim_svc", 1, 3}, {"roci-7", 0, 1}};
  {
    Journal journal(file, Durability::power);
    journal.put_goal(record);
    journal.commit();
  }
  const auto goals = Journal(file, Durability::power).goals();
  ASSERT_EQ(goals.size(), 1U);
  EXPECT_EQ(goals[0].request, record.request);
  EXPECT_EQ(goals[0].state, record.state);
  EXPECT_EQ(goals[0].reason, record.reason);
  EXPECT_EQ(goals[0].arrival, record.arrival);
  EXPECT_EQ(goals[0].plan_version, record.plan_version);
  EXPECT_EQ(goals[0].answers, record.answers);
  EXPECT_EQ(goals[0].before, record.before);
}

// Rejected goals may hold anything, and their record must not keep the executive from starting again.
TEST_F(JournalTest, ARejectedGoalOfGarbageComesBack) {
  GoalRecord record;
  record.request = testing::photo("ridge", GoalClass::optional, std::numeric_limits<double>::quiet_NaN());
  record.request.kind = "\xff";
  record.state = GoalState::rejected;
  {
    Journal journal(file, Durability::power);
    journal.put_goal(record);
    journal.commit();
  }
  const auto goals = Journal(file, Durability::power).goals();
  ASSERT_EQ(goals.size(), 1U);
  EXPECT_EQ(goals[0].state, GoalState::rejected);
  EXPECT_TRUE(std::isnan(goals[0].request.utility[0]));
}

TEST_F(JournalTest, EachStartHasALaterEpoch) {
  EXPECT_EQ(Journal(file, Durability::process).next_epoch(), 1U);
  EXPECT_EQ(Journal(file, Durability::process).next_epoch(), 2U);
}

TEST_F(JournalTest, RecordsKeepTheirOrder) {
  Journal journal(file, Durability::process);
  journal.append(seconds(2), "command", "b");
  journal.append(seconds(1), "ack", "a");
  journal.commit();
  std::vector<std::string> seen;
  journal.for_each([&](temporal::Time time, std::string_view kind, std::string_view text) {
    seen.push_back(std::to_string(time.count()) + " " + std::string(kind) + " " + std::string(text));
  });
  EXPECT_THAT(seen, ::testing::ElementsAre("2000000 command b", "1000000 ack a"));
}

// A process does not grow with its journal.
TEST_F(JournalTest, KeepsFewOfItsPagesInMemory) {
  Journal journal(file, Durability::process);
  const auto before = sqlite3_memory_used();
  for (int number = 0; number < 8000; ++number) {
    journal.append(seconds(number), "trace", std::string(1000, 'x'));
    if (number % 10 == 0) journal.commit();
  }
  EXPECT_LT(sqlite3_memory_used() - before, 600'000) << "of 8 MB";
}

TEST_F(JournalTest, AForeignFileIsRefusedByName) {
  std::ofstream(file) << "this is no database, and long enough to be looked at as one";
  try {
    Journal journal(file, Durability::process);
    FAIL() << "opened";
  } catch (const JournalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(file.string()));
  }
}

TEST(TraceTest, IsTheSha256OfItsLines) {
  Trace trace;
  EXPECT_EQ(trace.sha256(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  trace.add("abc");  // printf 'abc\n' | sha256sum
  EXPECT_EQ(trace.sha256(), "edeaaff3f1774ad2888673770c6d64097e391bc362d7d6fb34982ddf0efd18cb");
}

}  // namespace
}  // namespace roci::exec
