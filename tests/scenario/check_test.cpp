// roci-check as users start it, and the command lines that no program takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

// A mission of data alone, with two slips in its scenario.
class BadWell : public ::testing::Test {
 protected:
  BadWell() {
    fs::create_directories(folder / "scenarios");
    fs::copy_file(ROCI_SOURCE_DIR "/tests/missions/well/domain.pddl", folder / "domain.pddl");
    std::ifstream in(ROCI_SOURCE_DIR "/tests/missions/well/mission.yaml");
    std::ofstream out(folder / "mission.yaml");
    for (std::string line; std::getline(in, line);)
      out << (line.starts_with("site:") ? "site: " ROCI_SOURCE_DIR "/missions/planetary/site/site.yaml"
                                        : line)
          << "\n";
    std::ofstream(folder / "scenarios/nominal.yaml") << "duration_s: 100\n"
                                                        "start: {x: 40, y: 40, battery: 310000}\n"
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

// How many goal kinds of a mission are planned dry, and why the others are not (none: all are).
struct Shipment {
  const char* mission;
  const char* planned;
  const char* why_not = nullptr;
};

void PrintTo(const Shipment& shipment, std::ostream* out) { *out << shipment.mission; }

// ./run asks roci-check first, and flies nothing in which it finds an error.
class Shipped : public ::testing::TestWithParam<Shipment> {};

TEST_P(Shipped, MissionsHaveNothingToFindAndTheirGoalKindsArePlannedAsFarAsSaid) {
  const Ended ended = run(std::string("roci-check ") + ROCI_SOURCE_DIR + "/" + GetParam().mission + " 2>&1");
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, EndsWith(std::string(" read, ") + GetParam().planned + ", nothing found\n"));
  if (GetParam().why_not == nullptr) {
    EXPECT_THAT(ended.output, Not(HasSubstr("was not planned")));
  } else {
    EXPECT_THAT(ended.output, HasSubstr(std::string("was not planned: ") + GetParam().why_not));
  }
}

constexpr const char* kNetworks = "engine 'utility_htn' reads no PDDL";
constexpr const char* kTimelines = "engine 'timeline_htn' reads no PDDL";

INSTANTIATE_TEST_SUITE_P(
    Missions, Shipped,
    ::testing::Values(Shipment{"missions/planetary", "3 goal kinds planned"},
                      Shipment{"missions/orbital", "3 goal kinds planned"},
                      Shipment{"missions/europa", "0 goal kinds planned", kNetworks},
                      Shipment{"missions/europa-bsm1", "0 goal kinds planned", kNetworks},
                      Shipment{"missions/europa-autonomous", "0 goal kinds planned", kNetworks},
                      Shipment{"missions/faster", "0 goal kinds planned", kTimelines},
                      Shipment{"tests/missions/lander", "0 goal kinds planned", kNetworks},
                      Shipment{"tests/missions/convoy", "0 goal kinds planned",
                               "where 'scout' begins, 'scout.locomotion' alone says"}),
    [](const auto& tested) {
      std::string name = tested.param.mission;
      std::ranges::replace_if(
          name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

TEST_F(BadWell, EndsWithOneAndAllFindings) {
  const Ended ended = run("cd " + folder.string() + " && roci-check . 2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(
      ended.output,
      AllOf(HasSubstr("scenarios/nominal.yaml:2:32: error: the battery would begin with 310000 J"),
            HasSubstr("scenarios/nominal.yaml:3:10: error: no service tells of an event 'plan.adoptde'\n"
                      "    did you mean 'plan.adopted'?\n"),
            HasSubstr("well: 1 scenario read, 0 goal kinds planned, 2 findings")));
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
