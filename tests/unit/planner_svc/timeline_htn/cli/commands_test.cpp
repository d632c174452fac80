// The commands for authors of models of timelines: what they print, and with which code they end.
#include "planner_svc/timeline_htn/cli/commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr, testing::StartsWith;

class RociTimelines : public testing::Test {
 protected:
  RociTimelines() : folder_(fs::temp_directory_path() / ("roci-timelines-cli-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::string text = text_of_file("tests/missions/porter/porter.yaml");
    text = with(
        text,
        "metres: {arguments: [place, place], symmetric: true, rows: [[dock, gate, 6], [gate, yard, 10]]}",
        "drive_s: {arguments: [place, place], asked: {module: paths, function: way, rows_of: path}}");
    text = with(text, "[\"metres(from, to) / 0.5\", \"metres(from, to) / 0.5 + 120\"]",
                "[\"drive_s(from, to)\", \"2 * drive_s(from, to)\"]");
    text = with(text, "initial: {errand: idle}", "initial: {errand: idle, base: at(dock), gripper: empty}");
    put("red.yaml", with(text, "goals: {}", "goals: {g: errand.fetched(red)}"));
    put("blue.yaml", with(text, "goals: {}", "goals: {g: errand.fetched(blue)}"));
    put("values", "(way dock gate) 10\n(way gate dock) 12\n(way gate yard) unknown\n(way yard gate) 5\n");
  }
  ~RociTimelines() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  ExitCode plan_of(const std::string& model, const std::string& values, const Output& output) {
    PlanOptions options;
    if (!values.empty()) options.functions = folder_ / values;
    return plan({folder_ / model}, options, output);
  }

  fs::path folder_;
  std::ostringstream out_, errors_;
  Output output_{out_, errors_};
  Output json_{out_, errors_, true};
};

TEST_F(RociTimelines, TakesValuesOfExternalFunctionsFromAFile) {
  EXPECT_EQ(plan_of("red.yaml", "values", output_), done);
  EXPECT_THAT(out_.str(), HasSubstr("base.driving(dock, gate)  [0, 7168] to [10, 7178]"));
  EXPECT_EQ(plan_of("blue.yaml", "values", output_), unsolved);
  EXPECT_THAT(errors_.str(), HasSubstr("timeout: not known: " + (folder_ / "values").string() +
                                       " found no way for (way gate yard) with the effort spent"));
}

TEST_F(RociTimelines, SaysWhichValueLacks) {
  EXPECT_EQ(plan_of("red.yaml", "", output_), no_functions);
  EXPECT_THAT(errors_.str(),
              HasSubstr("red.yaml:13:47: number 'drive_s': external function (way dock gate) of module "
                        "paths: unavailable; start the service that offers module paths, or give the "
                        "values in a file"));
  put("values", "(way dock gate");
  EXPECT_EQ(plan_of("red.yaml", "values", json_), faulty);
  EXPECT_THAT(out_.str(), HasSubstr("values:1:15: error: ')' expected"));
}

TEST_F(RociTimelines, EndsWithAVerdictWhereTheMemoryIsSpent) {
  PlanOptions options;
  options.megabytes = 1;
  options.resolvers.assign(64, search::Resolver{});  // each has its part of it
  EXPECT_EQ(plan({ROCI_SOURCE_DIR "/missions/faster/problem.yaml"}, options, output_), out_of_memory);
  EXPECT_THAT(errors_.str(), StartsWith("out_of_memory: the searches have kept all of --memory 1 MiB; give "
                                        "them more, fewer resolvers or another heuristic; so far: "));
  EXPECT_EQ(plan({ROCI_SOURCE_DIR "/missions/faster/problem.yaml"}, options, json_), out_of_memory);
  EXPECT_EQ(nlohmann::json::parse(out_.str())["verdict"], "out_of_memory");
  options.megabytes = 0;
  options.resolvers.resize(1);
  EXPECT_EQ(plan({ROCI_SOURCE_DIR "/missions/faster/problem.yaml"}, options, output_), done) << "no bound";
}

}  // namespace
}  // namespace roci::planner::timeline_htn::cli
