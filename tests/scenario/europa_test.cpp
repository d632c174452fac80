// Both reference missions of the Europa lander, flown by every service as a process of its own: Basic Surface Mission
// 1, and Reference Surface Mission 1 in the scenarios of MEXEC, section V.B
// (R107–R109, R111, R112, R114, R118, R124, R127). Built twice: with some scenarios for ./check, with all of them for
// ./check --full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "tests/scenario/europa_rules.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
const std::string kMissions = std::string(ROCI_SOURCE_DIR) + "/missions/";

/// Says for a flight by which mission and scenario it goes, where these are not `europa` and the flight's own name.
const std::map<std::string, std::pair<std::string, std::string>> kElsewhere{
    {"basic", {"europa-bsm1", "nominal"}},
    {"autonomous", {"europa-autonomous", "nominal"}},
};

// What is on Earth of samples and surveys is worth so much (model.yaml).
double worth(const Course& course) {
  double out = 0;
  for (const Course::Product& product : course.products()) {
    if (product.received_s < 0) continue;
    if (product.kind.starts_with("raw_")) out += 0.6;
    if (product.kind.starts_with("compressed_")) out += 0.4;
    if (product.kind == "panorama" || product.kind == "quakes") out += 0.1;
  }
  return out;
}

class Europa : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  ~Europa() override { fs::remove_all(folder_); }

  Flight flight_of(const std::string& of, const std::string& transport) const {
    fs::remove_all(folder_);
    const auto elsewhere = kElsewhere.find(of);
    const auto& [mission, file] =
        elsewhere == kElsewhere.end() ? std::pair<std::string, std::string>("europa", of) : elsewhere->second;
    return fly(kMissions + mission, transport, 1, "--scenario " + file + " --run-folder " + folder_.string());
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_europa_" + std::to_string(::getpid()));
  const std::string scenario = std::get<0>(GetParam());
  const std::string dds = std::get<1>(GetParam());
};

TEST_P(Europa, SucceedsWithTheTraceOfTheReference) {
  static std::map<std::string, std::string> traces;  // over inproc; cases may share this process
  std::string& trace = traces[scenario];
  if (trace.empty() && dds != "inproc")
    trace = flight_of(scenario, "inproc").summary.value("trace_sha256", "no trace");
  const Flight flight = flight_of(scenario, dds);
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_EQ(flight.summary.value("dds", ""), dds);
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  const Course course(folder_);
  check_rules(scenario, course, folder_);
  if (trace.empty()) trace = flight.summary.value("trace_sha256", "");
  EXPECT_EQ(flight.summary.value("trace_sha256", ""), trace);
  if (scenario == "comm_energy_35" && dds == "inproc") {
    const double home = worth(course);
    EXPECT_EQ(flight_of("all_positive", dds).summary.value("result", ""), "achieved");
    EXPECT_GE(home, worth(Course(folder_))) << "a limit was lifted";
  }
}

std::string name_of(const ::testing::TestParamInfo<Europa::ParamType>& test) {
  return std::get<0>(test.param) + "_" + std::get<1>(test.param);
}

#ifdef ROCI_ALL_SCENARIOS
const auto kScenarios = ::testing::Values(
    "nominal", "all_positive", "all_negative", "first_negative", "low_start", "sudden_low", "ground_reorders",
    "more_decisional", "more_mandatory", "comm_energy_35", "cold_85K", "slow_downlink", "ground_one_target",
    "ground_lets_go", "ground_positive", "autonomous", "basic");
INSTANTIATE_TEST_SUITE_P(AllScenarios, Europa,
                         ::testing::Combine(kScenarios,
                                            ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed")),
                         name_of);
#else
INSTANTIATE_TEST_SUITE_P(Scenarios, Europa,
                         ::testing::Combine(::testing::Values("all_negative"),
                                            ::testing::Values("fastdds", "cyclonedds", "mixed")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Alone, Europa,
                         ::testing::Combine(::testing::Values("first_negative", "sudden_low",
                                                              "ground_positive", "basic"),
                                            ::testing::Values("inproc")),
                         name_of);
#endif

}  // namespace
}  // namespace roci::scenario
