#include "rehearsal/flight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace roci::rehearsal {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::HasSubstr, ::testing::IsSupersetOf, ::testing::Not;

class Rehearsal : public ::testing::Test {
 protected:
  Rehearsal() { fs::create_directories(folder_); }
  ~Rehearsal() override { fs::remove_all(folder_); }

  // The events that were written down, in order.
  std::vector<nlohmann::json> events_of(const fs::path& mission, const std::string& scenario) const {
    FlightOptions options;
    options.run.mission = mission;
    options.run.scenario = scenario;
    options.run.run_folder = folder_ / ("run of " + mission.filename().string());
    fs::create_directories(options.run.run_folder);
    fly(options);
    std::vector<nlohmann::json> out;
    std::ifstream in(options.run.run_folder / kEventsFile);
    for (std::string line; std::getline(in, line);) {
      out.push_back(nlohmann::json::parse(line));
      EXPECT_GE(out.back().at("time_us").get<std::int64_t>(), 0) << line;
      EXPECT_TRUE(out.back().contains("text")) << line;
    }
    return out;
  }
  // "sender code" of each.
  std::vector<std::string> flown(const std::string& scenario) const {
    std::vector<std::string> out;
    for (const auto& event : events_of(kLander, scenario))
      out.push_back(event.at("sender").get<std::string>() + " " + event.at("code").get<std::string>());
    return out;
  }
  // The lander with other words for its planner.
  fs::path lander_with(const std::string& words) const {
    const fs::path mission = folder_ / "mission";
    fs::copy(kLander, mission, fs::copy_options::recursive);
    std::ifstream in(kLander / "mission.yaml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    static constexpr char kEngine[] = "  engine: utility_htn\n";
    text.insert(text.find(kEngine) + std::string(kEngine).size(), "  " + words + "\n");
    std::ofstream(mission / "mission.yaml") << text;
    return mission;
  }

  const fs::path kLander = ROCI_SOURCE_DIR "/tests/missions/lander";

  const fs::path folder_ = fs::temp_directory_path() / ("roci_rehearsal_" + std::to_string(::getpid()));
};

TEST_F(Rehearsal, KeepsWhatEachServiceSaidToTheLast) {
  const auto events = flown("nominal");
  EXPECT_THAT(events, IsSupersetOf({"exec_svc goal.accepted", "planner_svc planner.cycle",
                                    "exec_svc goal.achieved", "sim_svc scenario.over"}));
  EXPECT_THAT(events, Not(Contains("planner_svc planner.defect")));
}

// Beyond the paper: the mission may have plans searched in passes, which say how far from the best they may be at most.
TEST_F(Rehearsal, AnAnytimeSearchTellsItsGap) {
  const auto events = events_of(lander_with("resolvers: [anytime]"), "nominal");
  int gaps = 0;
  for (const auto& event : events) {
    const std::string text = event.at("text");
    if (event.at("code") != "planner.cycle" || text.find("none has more than") == std::string::npos) continue;
    ++gaps;
    const std::string gap = text.substr(text.find("(gap "));
    EXPECT_THAT(gap, Not(HasSubstr("-"))) << "a plan is better than the best possible: " << text;
  }
  EXPECT_GT(gaps, 0);
  EXPECT_TRUE(
      std::ranges::any_of(events, [](const auto& event) { return event.at("code") == "goal.achieved"; }));
}

TEST_F(Rehearsal, ARobustSearchLooksAtMoreAndLessEnergyToo) {
  const auto explored = [](const std::vector<nlohmann::json>& events) {
    std::uint64_t all = 0;
    for (const auto& event : events) {
      const std::string text = event.at("text");
      const auto at = text.find(" explored");
      if (event.at("code") == "planner.cycle" && at != std::string::npos)
        all += std::stoull(text.substr(text.rfind(' ', at - 1) + 1));
    }
    return all;
  };
  const std::uint64_t once = explored(events_of(kLander, "nominal"));
  const auto robust = events_of(lander_with("resolvers: [robust, earliest]"), "nominal");
  EXPECT_GT(explored(robust), 2 * once);
  EXPECT_TRUE(
      std::ranges::any_of(robust, [](const auto& event) { return event.at("code") == "goal.achieved"; }));
}

}  // namespace
}  // namespace roci::rehearsal
