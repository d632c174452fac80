// Thirty days of the Europa lander with a battery to match, every service a process of its own: after the first day
// planner and executive take no more memory (R82).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kDay = 86400;

// 22 days and 180 MJ become 30 days and 250 MJ; Earth rises twice more, and there is something to do in these views.
void make_longer(const fs::path& mission) {
  edit(mission / "model.yaml", "battery_j: {value: 50 * 3600000", "battery_j: {value: 250000000");
  edit(mission / "model.yaml", "mission_length_s: {value: 22 * 86400",
       "mission_length_s: {value: 30 * 86400");
  edit(mission / "mission.yaml", "capacity_j: 180000000", "capacity_j: 250000000");
  edit(mission / "mission.yaml", "[1814400, 1962000]]",
       "[1814400, 1962000], [2116800, 2264400], [2419200, 2566800]]");
  edit(mission / "mission.yaml", "[[1900000, 1962000]]", "[[2590000, 2650000]]");
  edit(mission / "earth.yaml", "view: {from: 0, to: 6}", "view: {from: 0, to: 8}");
  edit(mission / "rsm1.yaml", "view: {from: 0, to: 6}", "view: {from: 0, to: 8}");
  for (int survey = 0; survey < 2; ++survey)
    edit(mission / "rsm1.yaml", "n: {from: 0, to: 6}", "n: {from: 0, to: 8}");
  std::ofstream(mission / "scenarios/thirty_days.yaml")
      << "duration_s: 2600000\nstart: {battery: 250000000}\nworld: {signatures: positive}\nstimuli:\n"
         "  - {at_s: 10, goal: {id: mission, kind: mission, importance: hard}}\n";
}

constexpr double kMostKib = 64 * 1024;  // of each process, after the first day

struct Peaks {
  double first_half = 0, second_half = 0;  // KiB, of what comes after the first day
  int samples = 0;
};

class LanderMemory : public ::testing::TestWithParam<const char*> {
 protected:
  ~LanderMemory() override {
    fs::remove_all(folder_);
    fs::remove_all(mission_);
  }
  const fs::path folder_ = fs::temp_directory_path() / ("roci_lander_memory_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_.string() + "_mission";
};

TEST_P(LanderMemory, OfPlannerAndExecutiveIsFlatAfterTheFirstDayOfThirty) {
  fs::remove_all(folder_);
  fs::remove_all(mission_);
  fs::copy(ROCI_SOURCE_DIR "/missions/europa", mission_, fs::copy_options::recursive);
  make_longer(mission_);
  const Ended ended = run(
      ROCI_SOURCE_DIR "/tests/scenario/memory_in_flight.sh \"$(dirname \"$(command -v roci-launch)\")\" " +
      mission_.string() + " " + std::string(GetParam()) + " " + folder_.string() +
      " --scenario thirty_days --speed max");
  const auto summary = last_line_as_json(ended.output);
  EXPECT_EQ(summary.value("result", ""), "achieved") << ended.output;
  EXPECT_GT(summary.value("sim_s", 0.0), 29 * kDay);
  std::map<std::string, Peaks> processes;
  std::istringstream in(ended.output);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double seconds = 0, kib = 0;
    std::string process;
    if (!(words >> seconds >> process >> kib) || seconds < kDay) continue;
    Peaks& peaks = processes[process];
    double& peak = seconds < 15 * kDay ? peaks.first_half : peaks.second_half;
    peak = std::max(peak, kib);
    ++peaks.samples;
  }
  ASSERT_GE(processes.size(), 2U) << ended.output;
  for (const auto& [process, peaks] : processes) {
    std::cout << process << ": " << peaks.first_half << " KiB at most to day 15, " << peaks.second_half
              << " KiB to day 30, " << peaks.samples << " samples\n";
    EXPECT_GT(peaks.samples, 40) << process;
    EXPECT_LE(peaks.second_half, 1.02 * peaks.first_half) << process;
    EXPECT_LT(std::max(peaks.first_half, peaks.second_half), kMostKib) << process;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, LanderMemory, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
