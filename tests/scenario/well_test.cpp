// A robot without an arm and without a camera, whose drill and charger are data: its owner's own actions fly through
// the programs that users start, without any code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

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

  // How often each kind of deed was done (effects.jsonl).
  std::map<std::string, int> deeds() const {
    std::map<std::string, int> out;
    std::ifstream in(folder_ / "effects.jsonl");
    for (std::string line; std::getline(in, line);) ++out[json::parse(line).value("kind", "")];
    return out;
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("roci_well_" + std::to_string(::getpid()));
};

TEST_F(Well, BoresAndChargesByData) {
  const Flight flight = launch("nominal", "mixed");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(deeds()["bore"], 2);
  EXPECT_GE(deeds()["charge"], 1);
}

TEST_F(Well, BoresWithADrillThatIsStuckSlowAndOutOfOrder) {
  const Flight flight = launch("bad_drill", "cyclonedds");
  ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_GT(deeds()["bore"], 2) << "one was begun in vain";
}

}  // namespace
}  // namespace roci::scenario
