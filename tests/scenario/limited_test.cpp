// Whole missions on a small computer: one core for all processes, and 512 MiB of data for each (R65): stacks, heap
// and whatever else it may write to. Address space that is only set aside (arenas of the C library) does not count.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <tuple>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

constexpr int kMebibytes = 512;

std::string on_one_core(int mebibytes, const std::string& command) {
  const std::string core = "taskset -c $(taskset -cp $$ | sed 's/.*: //; s/[-,].*//') ";
  return "prlimit --data=" + std::to_string(std::uint64_t{1024} * 1024 * mebibytes) + " " + core + command;
}

Flight fly_limited(int mebibytes, const std::string& scenario, const std::string& dds) {
  const Ended ended =
      run(on_one_core(mebibytes, "roci-launch " ROCI_SOURCE_DIR "/missions/planetary --scenario " + scenario +
                                     " --dds " + dds + " --seed 1 --speed max --headless --json"));
  return {ended.exit_code, last_line_as_json(ended.output)};
}

class Limited : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(Limited, EndsAsWithoutLimitsAndSoDoesThePlanner) {
  const auto [scenario, dds] = GetParam();
  const Flight free = fly(ROCI_SOURCE_DIR "/missions/planetary", "inproc", 1, "--scenario " + scenario);
  const Flight flight = fly_limited(kMebibytes, scenario, dds);
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(flight.summary.value("trace_sha256", "no trace"), free.summary.value("trace_sha256", ""));
  EXPECT_GT(flight.summary["planner"].value("calls", 0), 0);
  EXPECT_LT(flight.summary["planner"].value("max_rss_mb", 1e9), kMebibytes);
}

const auto kScenarios = ::testing::Values("nominal", "blocked_window", "opportunistic", "too_many");
INSTANTIATE_TEST_SUITE_P(Planetary, Limited,
                         ::testing::Combine(kScenarios, ::testing::Values("fastdds", "cyclonedds")),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::get<1>(test.param);
                         });

TEST(Limits, AreThoseOfEveryProcess) {
  EXPECT_EQ(run(on_one_core(kMebibytes, "sh -c 'ulimit -d; nproc'")).output, "524288\n1\n");
  EXPECT_NE(fly_limited(48, "nominal", "fastdds").exit_code, 0) << "a limit that nothing can keep";
}

}  // namespace
}  // namespace roci::scenario
