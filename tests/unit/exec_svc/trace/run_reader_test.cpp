#include "exec_svc/trace/run_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "exec_svc/journal/format.hpp"
#include "exec_svc/trace/trace_text.hpp"
#include "tests/unit/exec_svc/golden/golden.hpp"
#include "tests/unit/exec_svc/trace/map_folder.hpp"

namespace roci::exec::trace {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

std::string complaint(const std::filesystem::path& run, bool decisions = false) {
  try {
    read_run(run, decisions);
  } catch (const TraceError& error) {
    return error.what();
  }
  return "";
}

class RunReaderTest : public ::testing::Test {
 protected:
  const Folder folder;
  const std::filesystem::path file = folder.path() / "journal.sqlite";
};

TEST_F(RunReaderTest, TheJournalOfBaseline05IsRead) {
  exec::testing::make_golden_journal(1, file);
  const RecordedTrace trace = read_run(file, false);
  ASSERT_THAT(trace.lines, SizeIs(17));
  EXPECT_EQ(trace.lines[0], (Line{temporal::Time(0), "observation rover.nav idle-at(here) sampled 0", 1}));
  EXPECT_EQ(trace.lines[15].kind(), "plan");
  EXPECT_EQ(trace.lines[16].text,
            "command p1.1-drive 1 action=0 sim_svc nav drive to=place-ridge x=110 y=60");
  EXPECT_EQ(trace.lines[16].time, temporal::seconds(15));
  EXPECT_EQ(trace.lines[16].number, 17U);
}

TEST_F(RunReaderTest, DecisionsComeInTheirOrder) {
  exec::testing::make_golden_journal(1, file);
  const RecordedTrace all = read_run(folder.path(), true);
  ASSERT_THAT(all.lines, SizeIs(17 + 10 + 6 + 11 + 1));
  EXPECT_EQ(all.lines[0].text, "event service.found arm_svc is there");
  EXPECT_EQ(without_decisions(all), read_run(folder.path(), false));
}

TEST_F(RunReaderTest, ReadingChangesNothing) {
  exec::testing::make_golden_journal(1, file);
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  const auto before = std::filesystem::last_write_time(file);
  read_run(file, true);
  EXPECT_EQ(std::filesystem::last_write_time(file), before);
}

TEST_F(RunReaderTest, ScenarioAndSeedComeFromTheSummary) {
  std::filesystem::create_directories(folder.path() / "first");
  exec::testing::make_golden_journal(1, folder.path() / "first" / "journal.sqlite");
  folder.write("summary.json", R"({"scenario": "nominal", "seed": 7, "journal": "first/journal.sqlite"})");
  const RecordedTrace trace = read_run(folder.path(), false);
  EXPECT_EQ(trace.scenario, "nominal");
  EXPECT_EQ(trace.seed, 7U);
  EXPECT_THAT(trace.lines, SizeIs(17));
}

TEST_F(RunReaderTest, APrintedTraceIsTheSameTrace) {
  exec::testing::make_golden_journal(1, file);
  const RecordedTrace all = read_run(file, true);
  std::ostringstream out;
  print(out, all);
  const auto text = folder.write("a.trace", out.str());
  EXPECT_EQ(read_run(text, true), all);
  EXPECT_EQ(read_run(text, false), read_run(file, false));
}

TEST_F(RunReaderTest, WhatIsNoRunIsRefusedWithItsRemedy) {
  EXPECT_THAT(complaint(folder.path() / "none"), HasSubstr("check that it exists"));
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("there is no journal"), HasSubstr("give a run folder")));
  EXPECT_THAT(complaint(folder.write("a.txt", "hello\n")), HasSubstr("a.txt:1: "));
  EXPECT_THAT(complaint(folder.write("b.sqlite", "SQLite format 3 and rubbish")),
              AllOf(HasSubstr("b.sqlite cannot be read as a journal"), HasSubstr("give a run folder")));
  exec::testing::execute(folder.path() / "other.sqlite", "CREATE TABLE goal(id TEXT)");
  EXPECT_THAT(complaint(folder.path() / "other.sqlite"), HasSubstr("no such table: record"));
  EXPECT_THAT(complaint(folder.write("c.trace", "roci-trace 1 lines=trace\n0 ack a\n"), true),
              HasSubstr("holds the trace alone"));
  folder.write("bad/journal.sqlite", "");
  folder.write("bad/summary.json", "[1]");
  EXPECT_THAT(complaint(folder.path() / "bad"), HasSubstr("summary.json is no JSON object"));
}

TEST_F(RunReaderTest, NewerFormatsAreRefusedInWords) {
  exec::testing::make_golden_journal(1, file);
  exec::testing::execute(file, "PRAGMA user_version = " + std::to_string(journal::kFormat + 1));
  EXPECT_THAT(complaint(file),
              AllOf(HasSubstr("a journal of format"), HasSubstr("the version that wrote it")));
  folder.write("summary.json", R"({"format": 2})");
  EXPECT_THAT(complaint(folder.path()),
              AllOf(HasSubstr("a summary of format 2"), HasSubstr("reads up to 1")));
}

TEST_F(RunReaderTest, AFolderOfRunsIsListedByName) {
  folder.write("nominal-1.trace", "");
  folder.write("nominal-2/journal.sqlite", "");
  folder.write("nominal-3/other", "");
  folder.write("notes.txt", "");
  EXPECT_THAT(runs_in(folder.path()), ElementsAre(Pair("nominal-1", folder.path() / "nominal-1.trace"),
                                                  Pair("nominal-2", folder.path() / "nominal-2")));
  EXPECT_THAT(runs_in(folder.path() / "nominal-2"), IsEmpty());
  EXPECT_THAT(runs_in(folder.path() / "notes.txt"), IsEmpty());
}

}  // namespace
}  // namespace roci::exec::trace
