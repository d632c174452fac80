// exec_svc dies at a chosen point of a real flight, is started again by the launcher, and goes on with the
// plan that it was running: the same commands as in an undisturbed flight, each carried out once.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "exec_svc/journal/journal.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;

struct Record {
  int exit_code = -1;
  std::string result;
  std::string trace;
  nlohmann::json replayed;
  std::set<std::string> commanded;       // "activity attempt"
  std::multiset<std::string> completed;  // likewise, as often as their owner said so
  std::vector<std::string> events;
  long count(const std::string& code) const {
    return std::ranges::count_if(events,
                                 [&](const std::string& event) { return event.starts_with(code + " "); });
  }
};

std::string words(std::string_view line, std::size_t first, std::size_t count) {
  std::istringstream in{std::string(line)};
  std::string word, out;
  for (std::size_t i = 0; i < first + count && in >> word; ++i)
    if (i >= first) out += (out.empty() ? "" : " ") + word;
  return out;
}

Record fly_and_read(const std::string& dds, const std::string& crash) {
  const fs::path folder = fs::temp_directory_path() / ("roci_restart_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  const Ended ended =
      run("ROCI_CRASH=" + crash + " roci-launch " ROCI_SOURCE_DIR "/missions/planetary --dds " + dds +
          " --speed max --headless --json --run-folder " + folder.string());
  Record out;
  out.exit_code = ended.exit_code;
  out.result = last_line_as_json(ended.output).value("result", "");
  out.trace = last_line_as_json(ended.output).value("trace_sha256", "");
  out.replayed = last_line_as_json(run("roci replay --json " + folder.string()).output);
  exec::journal::Journal(folder / "journal.sqlite", exec::journal::Durability::process)
      .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
        if (kind == "event") out.events.emplace_back(text);
        if (kind != "trace") return;
        if (words(text, 1, 1) == "command" && words(text, 4, 1) == "action=0")
          out.commanded.insert(words(text, 2, 2));
        if (words(text, 1, 1) == "ack" && words(text, 4, 1) == "stage=2")
          out.completed.insert(words(text, 2, 2));
      });
  fs::remove_all(folder);
  return out;
}

class Restart : public ::testing::TestWithParam<const char*> {};

TEST_P(Restart, GoesOnWithTheRunningPlan) {
  const Record undisturbed = fly_and_read(GetParam(), "");
  ASSERT_EQ(undisturbed.result, "achieved");
  for (const char* crash : {"after-ack:3", "after-answer:1", "before-write-ahead:20", "after-write-ahead:20",
                            "during-send:9", "after-send:31,after-write-ahead:9"}) {
    SCOPED_TRACE(crash);
    const Record flight = fly_and_read(GetParam(), crash);
    EXPECT_EQ(flight.exit_code, 0);
    EXPECT_EQ(flight.result, "achieved");
    EXPECT_GE(flight.count("executive.resumed"), 1);
    EXPECT_EQ(flight.count("plan.adopted"), 1) << "the plan of before";
    EXPECT_EQ(flight.count("goal.achieved"), undisturbed.count("goal.achieved"));
    EXPECT_EQ(flight.commanded, undisturbed.commanded);
    EXPECT_EQ(flight.replayed.value("same", false), true) << flight.replayed;
    EXPECT_EQ(flight.replayed.value("replayed_sha256", ""), flight.trace);
    for (const std::string& key : undisturbed.commanded) EXPECT_GE(flight.completed.count(key), 1U) << key;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, Restart, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
