// Journals of every version that there ever was: read as what they are, or refused in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "exec_svc/archive/plan_fields.hpp"
#include "exec_svc/journal/format.hpp"
#include "exec_svc/journal/journaled_reactor.hpp"
#include "tests/unit/exec_svc/golden/golden.hpp"

namespace roci::exec {

using goals::GoalClass;
using goals::GoalKey;
using goals::GoalState;
using journal::Durability;
using journal::Journal;
using journal::JournaledReactor;
using journal::JournalError;
using mission::MissionModel;
using mission::read_mission;

namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class JournalFormatTest : public ::testing::Test {
 protected:
  JournalFormatTest() {
    file = std::filesystem::temp_directory_path() /
           ("roci_format_" + std::to_string(::getpid()) + "_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".sqlite");
    remove();
  }
  ~JournalFormatTest() override { remove(); }
  void remove() const {
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + suffix);
  }
  std::int64_t stated() const {
    std::int64_t version = -1;
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    sqlite3_exec(
        database, "PRAGMA user_version",
        [](void* out, int, char** values, char**) {
          *static_cast<std::int64_t*>(out) = std::stoll(values[0]);
          return 0;
        },
        &version, nullptr);
    sqlite3_close(database);
    return version;
  }
  std::string complaint() const {
    try {
      const Journal journal(file, Durability::process);
    } catch (const JournalError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path file;
};

TEST_F(JournalFormatTest, ANewJournalStatesItsFormat) {
  { const Journal journal(file, Durability::process); }
  EXPECT_EQ(stated(), journal::kFormat);
  { const Journal journal(file, Durability::process); }
  EXPECT_EQ(stated(), journal::kFormat);
}

TEST_F(JournalFormatTest, TheJournalOfBaseline05IsOfTheFirstVersionAndReadExactly) {
  testing::make_golden_journal(1, file);
  ASSERT_EQ(stated(), 0) << "it states none";
  const Journal journal(file, Durability::process);
  EXPECT_EQ(stated(), journal::kFormat);
  std::map<std::string, std::size_t> kinds;
  journal.for_each(
      [&](temporal::Time, std::string_view kind, std::string_view) { ++kinds[std::string(kind)]; });
  EXPECT_THAT(kinds, ElementsAre(Pair("anchor", 1), Pair("call", 1), Pair("event", 10), Pair("goal", 6),
                                 Pair("input", 6), Pair("step", 11), Pair("trace", 17)));
  const auto goals = journal.goals();
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_EQ(goals[1].request.key, (GoalKey{"ground", "soil"}));
  EXPECT_EQ(goals[1].request.kind, "pick_sample");
  EXPECT_EQ(goals[1].request.arguments, (std::map<std::string, std::string>{{"x", "150"}, {"y", "120"}}));
  EXPECT_EQ(goals[1].request.importance, GoalClass::hard);
  EXPECT_EQ(goals[1].state, GoalState::planned);
  EXPECT_EQ(goals[1].reason, "in plan 1");
  EXPECT_EQ(goals[1].plan_version, 1U);
  EXPECT_EQ(journal.peers().at("sim_svc"), 1U);
  EXPECT_EQ(journal.number("plan_version", 0), 1);
}

// Its inputs are of version 5: they are not read; goals and plan numbers are kept, and all is planned anew.
TEST_F(JournalFormatTest, AnExecutiveGoesOnFromTheJournalOfBaseline05) {
  testing::make_golden_journal(1, file);
  Journal journal(file, Durability::process);
  const MissionModel mission = read_mission(ROCI_SOURCE_DIR "/missions/planetary");
  const JournaledReactor executive(mission, journal);
  EXPECT_TRUE(executive.recovery().restarted);
  EXPECT_FALSE(executive.recovery().resumed);
  ASSERT_TRUE(executive.recovery().divergence);
  EXPECT_EQ(executive.recovery().divergence->got, "format 5");
  EXPECT_EQ(executive.reactor().goals().all().size(), 3U);
  EXPECT_EQ(executive.reactor().plan_version(), 1U);
  EXPECT_EQ(journal.number("format", 0), journal::kInputFormat);
}

// Whatever they hold: what cannot be read here stands for what would be misread.
TEST_F(JournalFormatTest, InputsOfEachOtherVersionAreSaidAndNeverRead) {
  const MissionModel mission = read_mission(ROCI_SOURCE_DIR "/missions/planetary");
  for (std::int64_t version = 0; version <= journal::kInputFormat + 1; ++version) {
    if (version == journal::kInputFormat) continue;
    SCOPED_TRACE(version);
    remove();
    testing::make_golden_journal(1, file);
    testing::execute(file, "UPDATE number SET value = " + std::to_string(version) +
                               " WHERE name = 'format';"
                               "UPDATE record SET text = X'00ff' WHERE kind = 'input' OR kind = 'anchor'");
    Journal journal(file, Durability::process);
    const JournaledReactor executive(mission, journal);
    EXPECT_FALSE(executive.recovery().resumed);
    ASSERT_TRUE(executive.recovery().divergence);
    EXPECT_EQ(executive.recovery().divergence->got, "format " + std::to_string(version));
    EXPECT_EQ(executive.reactor().goals().all().size(), 3U);
    EXPECT_EQ(executive.reactor().plan_version(), 1U);
    EXPECT_EQ(journal.number("format", 0), journal::kInputFormat) << "it goes on in its own";
  }
}

// Nobody observes it, so nobody could tell it again.
TEST_F(JournalFormatTest, WhatPlansHaveBroughtAboutOutlivesInputsThatAreNotRead) {
  testing::make_golden_journal(1, file);
  const std::map<std::string, temporal::Value> concluded{{"errand", temporal::state("fetched", {"red"})}};
  const MissionModel mission = read_mission(ROCI_SOURCE_DIR "/missions/planetary");
  Journal journal(file, Durability::process);
  journal.set_number("format", 4);
  journal.set_text("concluded", archive::to_bytes(concluded));
  journal.commit();
  const JournaledReactor executive(mission, journal);
  EXPECT_FALSE(executive.recovery().resumed);
  EXPECT_EQ(executive.reactor().concluded(), concluded);
}

TEST_F(JournalFormatTest, ANewerFormatIsRefusedInWordsAndLeftAlone) {
  testing::execute(
      file,
      "CREATE TABLE record(number INTEGER); PRAGMA user_version = " + std::to_string(journal::kFormat + 1) +
          "; PRAGMA application_id = " + std::to_string(journal::stamp_of(journal::kFormat + 1)));
  EXPECT_THAT(complaint(),
              AllOf(HasSubstr(file.string()), HasSubstr("format " + std::to_string(journal::kFormat + 1)),
                    HasSubstr("reads up to " + std::to_string(journal::kFormat)),
                    HasSubstr("the version that wrote it")));
  EXPECT_EQ(stated(), journal::kFormat + 1);
  EXPECT_THROW(testing::execute(file, "SELECT * FROM goal"), std::runtime_error) << "no table was made";
}

}  // namespace
}  // namespace roci::exec
