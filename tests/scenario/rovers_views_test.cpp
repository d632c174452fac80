// What an operator sees of two rovers while they fly: side by side, with the repair of one of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre, ::testing::HasSubstr, ::testing::IsSupersetOf;

class RoversViews : public ::testing::TestWithParam<const char*> {
 protected:
  RoversViews() { fs::create_directories(folder_); }
  ~RoversViews() override { fs::remove_all(folder_); }
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
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 250 " ROCI_SOURCE_DIR "/tests/scenario/rovers_views.sh ${PATH%%:*} " ROCI_SOURCE_DIR
          "/tests/missions/convoy " +
          std::string(GetParam()) + " " + std::to_string(domain.id()) + " " + folder_.string());
  auto steps = steps_of(ended.output);
  ASSERT_TRUE(steps["status"].printed.is_object()) << ended.output;
  const json& robots = steps["status"].printed["robots"];
  ASSERT_TRUE(robots.contains("primary") && robots.contains("scout")) << robots;
  EXPECT_EQ(robots["primary"]["states"]["locomotion"], "at w0");
  EXPECT_EQ(robots["scout"]["states"]["locomotion"], "scouting w1");
  EXPECT_TRUE(robots["primary"]["battery"].is_null());
  EXPECT_TRUE(robots["scout"]["battery"].is_number());
  EXPECT_TRUE(steps["status"].printed["decisions"].empty());
  EXPECT_THAT(steps["text"].printed.dump(), HasSubstr("locomotion        scouting w1"));

  std::vector<std::string> whose;
  ASSERT_TRUE(steps["plan"].printed.is_object()) << ended.output;
  for (const json& activity : steps["plan"].printed["activities"]) whose.push_back(activity["robot"]);
  EXPECT_THAT(whose, ElementsAre("scout", "primary", "scout", "primary"));

  // One that joins later sees it as well; until when there is time, only who heard the command knows.
  ASSERT_FALSE(steps["status"].printed["repairs"].empty()) << ended.output;
  EXPECT_EQ(steps["status"].printed["repairs"][0]["owner"], "scout.locomotion");
  EXPECT_EQ(steps["status"].printed["repairs"][0]["planned_end_s"], 85);
  const std::vector<json> seen = repairs_seen(ended.output);
  ASSERT_FALSE(seen.empty()) << ended.output;
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

INSTANTIATE_TEST_SUITE_P(Transports, RoversViews, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
