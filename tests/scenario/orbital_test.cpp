// The orbital mission, flown by every service as a process of its own over each transport (R55, R56). Built twice: with
// two scenarios for ./check, with all of them for ./check --full.
#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

const std::string kMission = std::string(ROCI_SOURCE_DIR) + "/missions/orbital";

// What a scenario ends with; the order of its events stands in its own file.
struct Ending {
  const char* scenario;
  int achieved;
  int dropped;
  int least_replans = 0;
};
std::ostream& operator<<(std::ostream& out, const Ending& ending) { return out << ending.scenario; }

class OrbitalTest : public ::testing::TestWithParam<std::tuple<Ending, std::string>> {
 protected:
  const Ending ending = std::get<0>(GetParam());
  const std::string dds = std::get<1>(GetParam());
};

TEST_P(OrbitalTest, EndsAsItsFileExpectsWithTheTraceOfTheReference) {
  const std::string scenario = std::string("--scenario ") + ending.scenario;
  const Flight flight = fly(kMission, dds, 1, scenario);
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_EQ(flight.summary["goals"].value("achieved", -1), ending.achieved);
  EXPECT_EQ(flight.summary["goals"].value("dropped", -1), ending.dropped);
  EXPECT_EQ(flight.summary["goals"].value("failed", -1), 0);
  EXPECT_GE(flight.summary.value("replans", -1), ending.least_replans);
  EXPECT_EQ(flight.summary.value("dds", ""), dds);
  EXPECT_GE(flight.summary["expected"].value("events", 0), 5);
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  if (dds != "inproc") {
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference_trace(kMission, scenario));
  }
}

std::string name_of(const ::testing::TestParamInfo<OrbitalTest::ParamType>& test) {
  return std::string(std::get<0>(test.param).scenario) + "_" + std::get<1>(test.param);
}

const auto kTransports = ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed");

#ifdef ROCI_ALL_SCENARIOS
const auto kEndings = ::testing::Values(Ending{"nominal", 2, 0}, Ending{"swap_full", 2, 0},
                                        Ending{"slow_joint", 2, 0, 2}, Ending{"heavy_module", 3, 0, 2},
                                        Ending{"blocked_slot", 1, 1, 1}, Ending{"module_fails", 2, 0, 1},
                                        Ending{"eclipse", 1, 2}, Ending{"dark_arrays", 2, 1, 1});
INSTANTIATE_TEST_SUITE_P(AllScenarios, OrbitalTest, ::testing::Combine(kEndings, kTransports), name_of);
#else
INSTANTIATE_TEST_SUITE_P(Scenarios, OrbitalTest,
                         ::testing::Combine(::testing::Values(Ending{"nominal", 2, 0},
                                                              Ending{"module_fails", 2, 0, 1}),
                                            kTransports),
                         name_of);
#endif

}  // namespace
}  // namespace roci::scenario
