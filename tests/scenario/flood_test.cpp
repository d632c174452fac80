// A stranger floods a flying mission with samples that are well-formed and that nobody wants: no process takes more
// memory than it may, the mission does what it does without him, and operators are told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <sstream>

#include "exec_svc/journal/journal.hpp"
#include "services/process/domain_claim.hpp"
#include "tests/contract/support/child_process.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using services::contract::ChildProcess;

// What a process may take that is flooded, whoever floods it and for how long (docs/resilience.md, "What is bounded").
constexpr std::size_t kMegabytes = 320;

class Flood : public ::testing::TestWithParam<const char*> {
 protected:
  ~Flood() override { fs::remove_all(folder_); }

  Flight fly_in(const std::string& name, int domain) const {
    const Ended ended =
        run("roci-launch " ROCI_SOURCE_DIR "/missions/planetary --dds " + std::string(GetParam()) +
            " --domain " + std::to_string(domain) + " --shared-domain --run " + name +
            " --speed max --headless --json --run-folder " + (folder_ / name).string());
    return {ended.exit_code, last_line_as_json(ended.output)};
  }

  // Plans, commands, acknowledgements and observations, without the stranger's.
  std::vector<std::string> trace_of(const std::string& name) const {
    std::vector<std::string> out;
    exec::journal::Journal(folder_ / name / "journal.sqlite", exec::journal::Durability::process)
        .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
          if (kind == "trace" && text.find("flood-") == text.npos) out.emplace_back(text);
        });
    return out;
  }

  // The peak of each process of the run so far, in megabytes, by the name of its program.
  void note_memory(const std::string& name, std::map<std::string, std::size_t>& peaks) const {
    const std::string run_folder = (folder_ / name).string();
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream in(entry.path() / "cmdline", std::ios::binary);
      const std::string command{std::istreambuf_iterator<char>(in), {}};
      if (command.find(run_folder) == command.npos || command.starts_with("sh")) continue;
      std::ifstream status(entry.path() / "status");
      std::string word, program;
      std::size_t kilobytes = 0;
      while (status >> word) {
        if (word == "Name:") status >> program;
        if (word == "VmHWM:") status >> kilobytes;
      }
      std::size_t& peak = peaks[program];
      peak = std::max(peak, kilobytes / 1024);
    }
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_flood_" + std::to_string(::getpid()));
};

TEST_P(Flood, ChangesNothingAndTakesBoundedMemory) {
  fs::create_directories(folder_);
  const services::process::DomainClaim domain;
  const Flight quiet = fly_in("quiet", domain.id());
  ASSERT_EQ(quiet.summary.value("result", ""), "achieved");
  ChildProcess intruder(
      {ROCI_BINARY_DIR "/tests/intruder", GetParam(), std::to_string(domain.id()), "flooded"});
  intruder.send("as intruder");
  intruder.send("flood 600");
  auto flight = std::async(std::launch::async, [&] { return fly_in("flooded", domain.id()); });
  std::map<std::string, std::size_t> peaks;
  while (flight.wait_for(0ms) != std::future_status::ready) {
    note_memory("flooded", peaks);
    intruder.wait_for_more(50ms);  // whoever does not read him stops him
  }
  const Flight flooded = flight.get();
  EXPECT_EQ(flooded.exit_code, 0);
  EXPECT_EQ(flooded.summary.value("result", ""), "achieved");
  EXPECT_EQ(trace_of("flooded"), trace_of("quiet"));
  for (const char* program : {"exec_svc", "sim_svc", "planner_svc", "pathplan_svc", "arm_svc", "science_svc"})
    EXPECT_GT(peaks[program], 0U) << program;
  for (const auto& [program, peak] : peaks) EXPECT_LE(peak, kMegabytes) << program;
  const auto told = [&intruder](const std::string& line) {
    return std::ranges::any_of(intruder.lines(),
                               [&](const std::string& heard) { return heard.starts_with(line); });
  };
  while (!told("event exec_svc goal.no_room ") && intruder.wait_for_more(1s)) {
  }
  for (const char* event : {"event exec_svc goal.no_room ", "event exec_svc timeline.no_room ",
                            "event pathplan_svc hazard.refused "})
    EXPECT_TRUE(told(event)) << event;
}

INSTANTIATE_TEST_SUITE_P(Transports, Flood, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
