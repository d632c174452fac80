// What `roci-trace` says of flown missions: the same flight twice is the same trace, and any other line is
// found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "exec_svc/trace/comparison.hpp"
#include "exec_svc/trace/run_reader.hpp"
#include "rehearsal/flight.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
namespace trace = exec::trace;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Flies in this process; the run folder stays until the tests end.
class TraceTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("roci_traces_" + std::to_string(::getpid()));
    fly("once", 1);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static void fly(const std::string& name, std::uint64_t seed) {
    static int domain = 0;
    rehearsal::FlightOptions options;
    options.run.mission = ROCI_SOURCE_DIR "/missions/planetary";
    options.run.scenario = "arm_fault";
    options.run.seed = seed;
    options.run.run_folder = folder_ / name;
    options.domain = ++domain;
    fs::create_directories(options.run.run_folder);
    rehearsal::fly(options);
  }

  static trace::Comparison compare(const std::string& before, const std::string& after) {
    return trace::compare(trace::read_run(folder_ / before, true), trace::read_run(folder_ / after, true),
                          {});
  }

  // A copy of a run with another journal.
  static void plant(const std::string& from, const std::string& name, const std::string& sql) {
    fs::copy(folder_ / from, folder_ / name, fs::copy_options::recursive);
    sqlite3* database = nullptr;
    sqlite3_open((folder_ / name / "journal.sqlite").c_str(), &database);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    EXPECT_GT(sqlite3_changes(database), 0);
    sqlite3_close(database);
  }

  static Ended roci_trace(const std::string& arguments) {
    return run("cd " + folder_.string() + " && roci-trace " + arguments);
  }

  static fs::path folder_;
};

fs::path TraceTest::folder_;

TEST_F(TraceTest, TheSameFlightTwiceIsTheSameTrace) {
  fly("again", 1);
  const trace::Comparison found = compare("once", "again");
  EXPECT_TRUE(found.equal());
  EXPECT_GT(found.before.size(), 100U);
  const Ended program = roci_trace("compare once again --decisions");
  EXPECT_EQ(program.exit_code, 0) << program.output;
  EXPECT_THAT(program.output, HasSubstr("equal: " + std::to_string(found.before.size()) + " lines"));
}

TEST_F(TraceTest, AnotherSeedIsAnotherTrace) {
  fly("other", 2);
  EXPECT_FALSE(compare("once", "other").equal());
}

TEST_F(TraceTest, APlantedDifferenceIsFound) {
  plant("once", "planted",
        "UPDATE record SET text = replace(text, 'stage=0', 'stage=1') "
        "WHERE seq = (SELECT max(seq) FROM record WHERE kind = 'trace' AND text LIKE '% ack %stage=0%')");
  ASSERT_THAT(compare("once", "planted").differences, SizeIs(1));
  const Ended program = roci_trace("compare once planted");
  EXPECT_EQ(program.exit_code, 1);
  EXPECT_THAT(program.output, AllOf(HasSubstr("different: 1 of "), HasSubstr("  - "), HasSubstr("stage=0"),
                                    HasSubstr("  + "), HasSubstr("stage=1")));
}

TEST_F(TraceTest, AMissingDecisionIsFoundAmongTheDecisionsAlone) {
  plant("once", "shorter",
        "DELETE FROM record WHERE seq = (SELECT min(seq) FROM record WHERE kind = 'step')");
  EXPECT_EQ(roci_trace("compare once shorter").exit_code, 0);
  EXPECT_EQ(roci_trace("compare once shorter --decisions").exit_code, 1);
}

TEST_F(TraceTest, OneMapLeadsFromOldToNew) {
  plant("once", "renamed",
        "UPDATE record SET text = replace(text, ' sim_svc ', ' world robot=rover ') "
        "WHERE kind = 'trace' AND text LIKE '% command %'");
  EXPECT_EQ(roci_trace("compare once renamed").exit_code, 1);
  std::ofstream(folder_ / "a.map.yaml")
      << "format: 1\n"
         "rewrites: [{kind: command, pattern: '(action=[0-9]+) sim_svc', with: '\\1 world'}]\n"
         "added: [{kind: command, field: robot}]\n"
         "accepted: [{old: '^never', reason: nothing is like this}]\n";
  const Ended mapped = roci_trace("compare once renamed --map a.map.yaml");
  EXPECT_EQ(mapped.exit_code, 0) << mapped.output;
  EXPECT_THAT(mapped.output,
              HasSubstr("a.map.yaml:4:12: the accepted difference 'nothing is like this' matches nothing"));
}

TEST_F(TraceTest, BadInputHasItsOwnCode) {
  std::ofstream(folder_ / "bad.map.yaml") << "format: 1\nname: {}\n";
  const Ended bad_map = roci_trace("compare once once --map bad.map.yaml 2>&1");
  EXPECT_EQ(bad_map.exit_code, 2);
  EXPECT_THAT(bad_map.output, HasSubstr("bad.map.yaml:2:1: unknown key 'name'"));
  EXPECT_EQ(roci_trace("print nothing 2>&1").exit_code, 2);
  plant("once", "never_began", "DELETE FROM record");
  EXPECT_EQ(roci_trace("compare never_began never_began 2>&1").exit_code, 2);
  EXPECT_EQ(roci_trace("compare once 2>&1").exit_code, 2);
}

TEST_F(TraceTest, APrintedTraceHasTheHashOfItsRun) {
  const Ended hash = roci_trace("print once | tail -n +2 | sha256sum | cut -c1-64");
  std::ifstream summary(folder_ / "once" / "summary.json");
  const std::string expected = nlohmann::json::parse(summary).at("trace_sha256");
  EXPECT_THAT(hash.output, HasSubstr(expected));
}

}  // namespace
}  // namespace roci::scenario
