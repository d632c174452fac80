// roci-check as users start it, and the command lines that no program takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// A mission of data alone, with two slips in its scenario.
class BadWell : public ::testing::Test {
 protected:
  BadWell() {
    fs::create_directories(folder / "scenarios");
    for (const char* file : {"mission.yaml", "domain.pddl"})
      fs::copy_file(fs::path(ROCI_SOURCE_DIR "/tests/missions/well") / file, folder / file);
    std::ofstream(folder / "scenarios/nominal.yaml") << "duration_s: 100\n"
                                                        "start: {x: 40, y: 40, battery: 260000}\n"
                                                        "expect: [plan.adoptde]\n";
  }
  ~BadWell() override { fs::remove_all(folder); }

  const fs::path folder =
      fs::temp_directory_path() / ("roci_bad_well_" + std::to_string(::getpid())) / "well";
};

TEST(Check, ASoundMissionEndsWithZero) {
  const Ended ended = run("roci-check " ROCI_SOURCE_DIR "/tests/missions/well 2>&1");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.output, EndsWith("well: 2 scenarios read, 1 goal kind planned, nothing found\n"));
}

TEST_F(BadWell, EndsWithOneAndAllFindings) {
  const Ended ended = run("cd " + folder.string() + " && roci-check . 2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(
      ended.output,
      AllOf(HasSubstr("scenarios/nominal.yaml:2:32: error: the battery would begin with 260000 J"),
            HasSubstr("scenarios/nominal.yaml:3:10: error: no service tells of an event 'plan.adoptde'\n"
                      "    did you mean 'plan.adopted'?\n"),
            HasSubstr("2 findings")));
}

TEST_F(BadWell, IsToldAsJson) {
  const Ended ended = run("roci-check --json " + folder.string());
  EXPECT_EQ(ended.exit_code, 1);
  const auto report = last_line_as_json(ended.output);
  ASSERT_EQ(report.value("findings", nlohmann::json::array()).size(), 2U) << ended.output;
  const auto& finding = report["findings"][1];
  EXPECT_EQ(finding.value("file", ""), (folder / "scenarios/nominal.yaml").string());
  EXPECT_EQ(finding.value("line", 0), 3);
  EXPECT_EQ(finding.value("column", 0), 10);
  EXPECT_EQ(finding.value("severity", ""), "error");
  EXPECT_EQ(finding.value("remedy", ""), "did you mean 'plan.adopted'?");
}

TEST(Check, AWrongCommandLineEndsWithTwo) {
  EXPECT_EQ(run("roci-check 2>&1").exit_code, 2);
  const Ended mission = run("roci-check mars 2>&1");
  EXPECT_EQ(mission.exit_code, 2);
  EXPECT_THAT(mission.output, HasSubstr("no mission \"mars\""));
  const Ended scenario = run("roci-check " ROCI_SOURCE_DIR "/tests/missions/well --scenario nominla 2>&1");
  EXPECT_EQ(scenario.exit_code, 2);
  EXPECT_THAT(scenario.output, HasSubstr("did you mean 'nominal'?"));
}

// It was taken for 18446744073709551613.
TEST(Check, ANegativeSeedIsRefused) {
  for (const char* program : {"roci-launch", "roci-rehearse"}) {
    const Ended ended = run(std::string(program) + " planetary --seed -3 2>&1");
    EXPECT_EQ(ended.exit_code, 2) << program;
    EXPECT_THAT(ended.output, HasSubstr("--seed")) << program;
  }
}

}  // namespace
}  // namespace roci::scenario
