// The two rovers of missions/faster by the programs that users start: the trial, and what its table of scenarios says (R128, R137–R140, R145–R149).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::HasSubstr, ::testing::Not, ::testing::StartsWith;

struct Row {
  const char* scenario;
  const char* transport;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.scenario << ' ' << row.transport; }

class Faster : public ::testing::TestWithParam<Row> {
 protected:
  ~Faster() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_faster_" + std::to_string(::getpid()));
};

// The events come in the order that the scenario lists, with the same trace on every transport; both rovers end whole, and no primary was in soil that
// does not bear it.
TEST_P(Faster, FliesAsListed) {
  static std::map<std::string, std::string> traces;
  const auto [scenario, transport] = GetParam();
  const Flight flight = fly(ROCI_SOURCE_DIR "/missions/faster", transport, 1,
                            std::string("--scenario ") + scenario + " --run-folder " + folder_.string());
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_THAT(journaled_events(folder_ / "journal.sqlite"), Not(Contains(HasSubstr("bogged-down"))));
  const std::string trace = flight.summary.value("trace_sha256", "");
  EXPECT_EQ(traces.emplace(scenario, trace).first->second, trace);
}

constexpr const char* kScenarios[] = {"trial",         "trial_stopped",   "fixed_times", "marker_not_seen",
                                      "scout_no_path", "primary_blocked", "scout_lost",  "no_path",
                                      "goal_change",   "repair_overrun",  "radio_loss",  "radio_cut"};
#ifdef ROCI_ALL_TRANSPORTS
constexpr const char* kTransports[] = {"inproc", "fastdds", "cyclonedds", "mixed"};
#else
constexpr const char* kTransports[] = {"inproc"};
#endif

std::vector<Row> rows() {
  std::vector<Row> out;
  for (const char* scenario : kScenarios)
    for (const char* transport : kTransports) out.push_back({scenario, transport});
#ifndef ROCI_ALL_TRANSPORTS
  for (const char* transport : {"fastdds", "cyclonedds", "mixed"}) out.push_back({"trial", transport});
#endif
  return out;
}

INSTANTIATE_TEST_SUITE_P(Table, Faster, ::testing::ValuesIn(rows()), [](const auto& row) {
  return std::string(row.param.scenario) + "_" + row.param.transport;
});

}  // namespace
}  // namespace roci::scenario
