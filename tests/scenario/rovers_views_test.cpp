// What an operator sees of two rovers while they fly: side by side, with the repair of one of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre, ::testing::HasSubstr;

class RoversViews : public ::testing::TestWithParam<const char*> {
 protected:
  RoversViews() { fs::create_directories(folder_); }
  ~RoversViews() override { fs::remove_all(folder_); }

  // What the ground sees of a flight until a repair has ended.
  std::string watched(const std::string& mission, const std::string& scenario, int speed) const {
    const services::process::DomainClaim domain;
    return run("timeout 280 " ROCI_SOURCE_DIR "/tests/scenario/rovers_views.sh ${PATH%%:*} " ROCI_SOURCE_DIR
               "/" +
               mission + " " + GetParam() + " " + std::to_string(domain.id()) + " " + folder_.string() + " " +
               scenario + " " + std::to_string(speed))
        .output;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_rovers_" + std::to_string(::getpid()));
};

// The repairs that each line of `roci watch --json` tells of.
std::vector<json> repairs_seen(const std::string& output) {
  std::vector<json> out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const json status = json::parse(line, nullptr, false);
    if (!status.is_object()) continue;
    for (const json& repair : status.value("repairs", json::array())) out.push_back(repair);
  }
  return out;
}

TEST_P(RoversViews, ShowBothSideBySideAndARepairFromItsBeginningToItsEnd) {
  const std::string output = watched("tests/missions/convoy", "repaired", 10);
  auto steps = steps_of(output);
  ASSERT_TRUE(steps["status"].printed.is_object()) << output;
  const json& robots = steps["status"].printed["robots"];
  ASSERT_TRUE(robots.contains("primary") && robots.contains("scout")) << robots;
  EXPECT_EQ(robots["primary"]["states"]["locomotion"], "at w0");
  EXPECT_EQ(robots["scout"]["states"]["locomotion"], "scouting w1");
  EXPECT_TRUE(robots["primary"]["battery"].is_null());
  EXPECT_TRUE(robots["scout"]["battery"].is_number());
  EXPECT_TRUE(steps["status"].printed["decisions"].empty());
  EXPECT_THAT(steps["text"].printed.dump(), HasSubstr("locomotion        scouting w1"));

  std::vector<std::string> whose;
  ASSERT_TRUE(steps["plan"].printed.is_object()) << output;
  for (const json& activity : steps["plan"].printed["activities"]) whose.push_back(activity["robot"]);
  EXPECT_THAT(whose, ElementsAre("scout", "primary", "scout", "primary"));

  // One that joins later sees it as well; until when there is time, only who heard the command knows.
  ASSERT_FALSE(steps["status"].printed["repairs"].empty()) << output;
  EXPECT_EQ(steps["status"].printed["repairs"][0]["owner"], "scout.locomotion");
  EXPECT_EQ(steps["status"].printed["repairs"][0]["planned_end_s"], 85);
  const std::vector<json> seen = repairs_seen(output);
  ASSERT_FALSE(seen.empty()) << output;
  EXPECT_EQ(seen.front()["state"], "under way");
  for (const json& repair : seen) {
    EXPECT_EQ(repair["owner"], "scout.locomotion");
    EXPECT_EQ(repair["robot"], "scout");
    EXPECT_EQ(repair["activity"], "p1.1-scout");
    EXPECT_THAT(repair["error"].get<std::string>(), HasSubstr("fault"));
    EXPECT_EQ(repair["since_s"], 30);
  }
  EXPECT_EQ(seen.back()["state"], "mended");
  ASSERT_TRUE(seen.back()["latest_end_s"].is_number()) << "the watcher was there before the command";
  EXPECT_GT(seen.back()["used"], 0);
  EXPECT_LT(seen.back()["used"], 1) << "it was mended in time";
}

// The last line of the watcher.
json newest_status(const std::string& output) {
  json out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (json status = json::parse(line, nullptr, false); status.is_object() && status.contains("robots"))
      out = std::move(status);
  return out;
}

// In the yard: the scout's drive ends before the trap, both maps have the place, the drive goes on around it.
TEST_P(RoversViews, ShowTheMapOfEachAndEveryLevelOfThePlan) {
  const std::string output = watched("missions/faster", "trial", 30);
  auto steps = steps_of(output);
  const json status = newest_status(output);
  ASSERT_TRUE(status.is_object() && status["robots"].contains("scout")) << output;
  for (const std::string robot : {"primary", "scout"}) {
    const json& its = status["robots"][robot];
    EXPECT_TRUE(its["pose"]["x_m"].is_number()) << robot;
    ASSERT_EQ(its["maps"].size(), 1U) << robot;
    EXPECT_EQ(its["maps"][0]["planner"], robot + ".path");
    ASSERT_EQ(its["maps"][0]["obstacles"].size(), 1U) << robot;
    EXPECT_EQ(its["maps"][0]["obstacles"][0]["found_by"], "scout");
    EXPECT_EQ(its["maps"][0]["obstacles"][0]["kind"], "soil");
  }
  EXPECT_EQ(status["robots"]["primary"]["maps"][0]["taken"][0]["author"], "scout.path");
  EXPECT_FALSE(status["robots"]["scout"]["maps"][0]["told"].is_null());
  const std::vector<json> seen = repairs_seen(output);
  ASSERT_FALSE(seen.empty()) << output;
  EXPECT_EQ(seen.back()["owner"], "scout.locomotion");
  EXPECT_EQ(seen.back()["state"], "mended");
  EXPECT_THAT(seen.back()["error"].get<std::string>(), HasSubstr("no-go"));
  ASSERT_TRUE(seen.back()["used"].is_number()) << "the watcher was there before the command";
  EXPECT_LT(seen.back()["used"], 1);

  std::map<std::string, json> plan;
  ASSERT_TRUE(steps["plan"].printed.is_object()) << output;
  for (const json& activity : steps["plan"].printed["activities"]) plan[activity["id"]] = activity;
  std::size_t deepest = 0;
  for (const auto& [id, activity] : plan) {
    std::size_t depth = 0;
    for (std::string parent = activity["parent"]; !parent.empty() && depth < 20; ++depth)
      parent = plan.contains(parent) ? plan[parent]["parent"].get<std::string>() : "";
    deepest = std::max(deepest, depth);
  }
  EXPECT_GE(deepest, 3U) << "traverse, team, cycle, step";
  EXPECT_EQ(steps["map"].exit_code, 0) << output;
  EXPECT_EQ(steps["map"].printed["known"], (json{{"primary", 1}, {"scout", 1}}));
  EXPECT_THAT(text_of(folder_ / "now.svg"), HasSubstr("soil of scout"));
}

INSTANTIATE_TEST_SUITE_P(Transports, RoversViews, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
