// One bad thing that comes over the wire is left out and named, and the mission goes on: a fact about an object that
// nobody has declared, a goal that no goal can be, and a goal for which the planner calls every problem invalid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "services/process/domain_claim.hpp"
#include "tests/contract/support/child_process.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using services::contract::ChildProcess;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class OneBadThing : public ::testing::TestWithParam<const char*> {
 protected:
  OneBadThing() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", mission_, fs::copy_options::recursive);
    edit(mission_ / "mission.yaml", "{name: planner_svc, ",
         "{name: planner_svc, program: " ROCI_BINARY_DIR "/tests/doubting-planner, ");
    std::ofstream(mission_ / "scenarios/short.yaml")
        << "description: A photo, and a goal of which the planner wants nothing to do.\n"
           "duration_s: 14400\n"
           "start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}\n"
           "science: {enabled: false}\n"
           "stimuli:\n"
           "  - {at_s: 10, goal: {issuer: ground, id: ridge, kind: photo, importance: hard, arguments: {x: "
           "52, "
           "y: 44}}}\n"
           "  - {at_s: 10, goal: {issuer: ground, id: taboo, kind: photo, importance: optional, utility: 1, "
           "arguments: {x: 60, y: 44}}}\n"
           "  - {at_s: 10, goal: {issuer: crew, id: ridge, kind: photo, importance: optional, utility: 1, "
           "arguments: {x: 60, y: 50}}}\n";
  }
  ~OneBadThing() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_bad_thing_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "planetary";
  const services::process::DomainClaim domain_;
};

TEST_P(OneBadThing, IsLeftOutAndNamedAndTheMissionGoesOn) {
  const std::string domain = std::to_string(domain_.id());
  ChildProcess stranger({ROCI_BINARY_DIR "/tests/intruder", GetParam(), domain, "bad-thing"});
  stranger.send("as stranger");
  stranger.send("observe rover.image.image-of-nobody stored");
  stranger.send("await 100 event sim_svc scenario.over");
  const Ended ended = run("timeout 100 roci-launch " + mission_.string() + " --scenario short --dds " +
                          GetParam() + " --domain " + domain +
                          " --shared-domain --run bad-thing --speed max --headless --json --run-folder " +
                          (folder_ / "run").string());
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  const nlohmann::json summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "achieved") << summary;
  EXPECT_THAT(
      journaled_events(folder_ / "run/journal.sqlite"),
      AllOf(Contains(AllOf(StartsWith("fact.left_out "), HasSubstr("image-of-nobody"))),
            Contains(AllOf(StartsWith("goal.rejected "), HasSubstr("crew/ridge"), HasSubstr("is in use"))),
            Contains(AllOf(StartsWith("goal.suspected "), HasSubstr("ground/taboo"))),
            Contains(AllOf(HasSubstr("ground/taboo"), HasSubstr("a word of the problem is taboo"))),
            Contains(StartsWith("goal.achieved goal ground/ridge")), Not(Contains(StartsWith("robot.saf")))));
}

INSTANTIATE_TEST_SUITE_P(Vendors, OneBadThing, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
