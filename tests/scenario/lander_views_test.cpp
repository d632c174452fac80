// What the planner of a lander expects of its plan, asked for at the console while it flies: downlinks,
// utility, energy, subway map; the map with outcomes is that of the Europa lander.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AnyOf, ::testing::ContainsRegex, ::testing::EndsWith, ::testing::HasSubstr,
    ::testing::IsSubsetOf, ::testing::StartsWith;

class LanderViews : public ::testing::TestWithParam<const char*> {
 protected:
  LanderViews() { fs::create_directories(folder_); }
  ~LanderViews() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::temp_directory_path() / ("roci_views_" + std::to_string(::getpid()));
};

TEST_P(LanderViews, AreToldByThePlannerAndShownByTheConsole) {
  const services::process::DomainClaim domain;
  const Ended ended =
      run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/lander_views.sh ${PATH%%:*} " ROCI_SOURCE_DIR
          "/tests/missions/lander " +
          std::string(GetParam()) + " " + std::to_string(domain.id()) + " " + folder_.string());
  auto steps = steps_of(ended.output);
  for (const std::string verb : {"downlinks", "utility", "energy", "subway", "chains"}) {
    EXPECT_EQ(steps[verb].exit_code, 0) << verb << "\n" << ended.output;
    EXPECT_EQ(steps[verb + "-text"].exit_code, 0) << verb << "\n" << ended.output;
    const std::string picture = text_of(folder_ / (verb + ".svg"));
    EXPECT_THAT(picture, StartsWith("<svg ")) << verb;
    EXPECT_THAT(picture, EndsWith("</svg>\n")) << verb;
    ASSERT_TRUE(steps[verb].printed.is_object()) << ended.output;
    EXPECT_EQ(steps[verb].printed["robot"], "lander") << verb;
    EXPECT_EQ(steps[verb].printed["network"], "small-lander") << verb;
  }
  std::set<std::string> scheduled;
  EXPECT_EQ(steps["downlinks"].printed["limited"], true);
  for (const json& downlink : steps["downlinks"].printed["downlinks"])
    for (const json& data : downlink["products"]) scheduled.insert(data["id"]);
  EXPECT_FALSE(scheduled.empty());
  EXPECT_THAT(scheduled, IsSubsetOf({"sample_near/image_near/picture", "sample_far/image_far/picture"}));
  std::set<std::string> requests;
  for (const json& chain : steps["utility"].printed["chains"]) requests.insert(chain["request"]);
  EXPECT_EQ(requests, (std::set<std::string>{"farewell", "sample_far", "sample_near", "view"}));
  EXPECT_EQ(steps["utility"].printed["ranks"][0]["name"], "science");
  EXPECT_EQ(steps["energy"].printed["budget"], "lander.battery");
  EXPECT_GT(steps["energy"].printed["energy"].size(), 3U);
  EXPECT_TRUE(steps["subway"].printed["sites"].empty());
  EXPECT_EQ(steps["nobody"].exit_code, 1) << ended.output;
  EXPECT_EQ(steps["no-folder"].exit_code, 2) << ended.output;
  EXPECT_THAT(steps["nobody-told"].printed.dump(), HasSubstr("for robot 'nobody'"));
}

// In all_negative the first sample that is analyzed, of site 1, closes the site, and the map leads to the next one.
TEST_P(LanderViews, TheSubwayMapShowsOutcomesOfSamples) {
  const services::process::DomainClaim domain;
  const std::string picture = (folder_ / "subway.svg").string();
  const Ended ended =
      run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/subway_view.sh ${PATH%%:*} " ROCI_SOURCE_DIR
          "/missions/europa all_negative " +
          std::string(GetParam()) + " " + std::to_string(domain.id()) + " " + picture);
  auto steps = steps_of(ended.output);
  ASSERT_EQ(steps["subway"].exit_code, 0) << ended.output;
  std::map<std::string, std::string> outcomes, states;
  for (const json& site : steps["subway"].printed["sites"])
    for (const json& target : site["targets"]) {
      const std::string task = target["task"];
      outcomes[task] = target["outcome"];
      states[task] = target["state"];
    }
  EXPECT_EQ(outcomes.size(), 9U) << ended.output;
  EXPECT_EQ(outcomes["sample_1_0"], "negative");
  EXPECT_EQ(states["sample_1_0"], "negative");
  for (const char* left : {"sample_1_1", "sample_1_2"}) EXPECT_EQ(states[left], "unknown") << left;
  EXPECT_THAT(states["sample_0_2"], AnyOf("planned", "next")) << "the next site";
  EXPECT_EQ(steps["subway-text"].exit_code, 0);
  EXPECT_THAT(steps["subway-text"].printed.dump(), ContainsRegex("sample_1_0 +[0-9.]+ +negative"));
  EXPECT_THAT(text_of(picture), HasSubstr("sample_1_0"));
}

INSTANTIATE_TEST_SUITE_P(Transports, LanderViews, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
