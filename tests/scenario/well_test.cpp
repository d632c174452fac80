// A robot without an arm and without a camera, whose drill and charger are data: its owner's own actions fly through
// the programs that users start, without any code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Well : public ::testing::Test {
 protected:
  ~Well() override { fs::remove_all(folder_); }

  Flight launch(const std::string& scenario, const std::string& dds) const {
    return fly(ROCI_SOURCE_DIR "/tests/missions/well", dds, 1,
               "--scenario " + scenario + " --run-folder " + folder_.string());
  }

  // When each deed of this kind was done, in seconds (effects.jsonl).
  std::vector<double> times_of(const std::string& kind) const {
    std::vector<double> out;
    std::ifstream in(folder_ / "effects.jsonl");
    for (std::string line; std::getline(in, line);) {
      const json deed = json::parse(line);
      if (deed.value("kind", "") == kind) out.push_back(deed.value("time_us", 0.0) / 1e6);
    }
    return out;
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("roci_well_" + std::to_string(::getpid()));
};

TEST_F(Well, BoresAndChargesByData) {
  const Flight flight = launch("nominal", "mixed");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(times_of("bore").size(), 2U);
  EXPECT_EQ(times_of("charge").size(), 1U) << "the energy does not suffice for both";
  ASSERT_EQ(times_of("motion").size(), 2U);
  EXPECT_LT(times_of("motion")[1], 900);
}

TEST_F(Well, BoresWithADrillThatIsStuckSlowAndOutOfOrder) {
  const Flight flight = launch("bad_drill", "cyclonedds");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(times_of("bore").size(), 3U) << "the second was begun in vain";
  ASSERT_GE(times_of("motion").size(), 2U);
  EXPECT_GT(times_of("motion")[1], 1000) << "stuck for 300 s and slow for 200 s, the first hole took longer";
}

}  // namespace
}  // namespace roci::scenario
