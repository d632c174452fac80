#include "rehearsal/flight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace roci::rehearsal {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::IsSupersetOf, ::testing::Not;

class Rehearsal : public ::testing::Test {
 protected:
  Rehearsal() { fs::create_directories(folder_); }
  ~Rehearsal() override { fs::remove_all(folder_); }

  // "sender code" of each event that was written down, in order.
  std::vector<std::string> flown(const std::string& scenario) const {
    FlightOptions options;
    options.run.mission = ROCI_SOURCE_DIR "/tests/missions/lander";
    options.run.scenario = scenario;
    options.run.run_folder = folder_;
    fly(options);
    std::vector<std::string> out;
    std::ifstream in(folder_ / kEventsFile);
    for (std::string line; std::getline(in, line);) {
      const auto event = nlohmann::json::parse(line);
      EXPECT_GE(event.at("time_us").get<std::int64_t>(), 0) << line;
      EXPECT_TRUE(event.contains("text")) << line;
      out.push_back(event.at("sender").get<std::string>() + " " + event.at("code").get<std::string>());
    }
    return out;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_rehearsal_" + std::to_string(::getpid()));
};

TEST_F(Rehearsal, KeepsWhatEachServiceSaidToTheLast) {
  const auto events = flown("nominal");
  EXPECT_THAT(events, IsSupersetOf({"exec_svc goal.accepted", "planner_svc planner.cycle",
                                    "exec_svc goal.achieved", "sim_svc scenario.over"}));
  EXPECT_THAT(events, Not(Contains("planner_svc planner.defect")));
}

}  // namespace
}  // namespace roci::rehearsal
