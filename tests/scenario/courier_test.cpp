// A plan that leaves open what comes next, the engine's answer, and the plan that is made of it (R131).
// By the programs that users start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class Courier : public ::testing::TestWithParam<const char*> {
 protected:
  ~Courier() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_courier_" + std::to_string(::getpid()));
};

// Nothing of what was planned on first is done, and nothing twice. Each transport gives the same trace.
TEST_P(Courier, GoesTheWayThatIsDecidedOnWhenTheDoorsAreSeen) {
  const std::string mission = ROCI_SOURCE_DIR "/tests/missions/courier", flown = "--scenario nominal";
  const Flight flight = fly(mission, GetParam(), 1, flown + " --run-folder " + folder_.string());
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_THAT(deeds_of(folder_), ElementsAre("look ", "drive dock south", "drive south hall"));
  if (GetParam() != std::string("inproc")) {
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(mission, flown));
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, Courier, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

}  // namespace
}  // namespace roci::scenario
