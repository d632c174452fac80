// The leading executive of a real flight dies at a chosen point, the one that stands by takes over, and the
// mission ends as if nothing had been: the same commands, each carried out once.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "exec_svc/journal/journal.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;

struct Record {
  int exit_code = -1;
  nlohmann::json summary;
  std::set<std::string> commanded;  // "activity attempt"
  nlohmann::json effects;           // on the world
  std::vector<std::string> events;
  nlohmann::json replayed;
  long count(const std::string& code) const {
    return std::ranges::count_if(events,
                                 [&](const std::string& event) { return event.starts_with(code + " "); });
  }
};

Record fly_and_read(const std::string& dds, const std::string& crash, const std::string& more,
                    const std::string& mission = "planetary") {
  const fs::path folder = fs::temp_directory_path() / ("roci_standby_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  const Ended ended =
      run("ROCI_CRASH=" + crash + " roci-launch " ROCI_SOURCE_DIR "/missions/" + mission + " --dds " + dds +
          " --speed max --headless --json --run-folder " + folder.string() + more);
  Record out;
  out.exit_code = ended.exit_code;
  out.summary = last_line_as_json(ended.output);
  const fs::path journal = folder / out.summary.value("journal", "journal.sqlite");
  out.replayed = last_line_as_json(run("roci replay --json " + journal.string()).output);
  exec::journal::Journal(journal, exec::journal::Durability::process)
      .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
        if (kind == "event") out.events.emplace_back(text);
        std::istringstream words{std::string(text)};
        std::string time, what, activity, attempt, action;
        words >> time >> what >> activity >> attempt >> action;
        if (kind == "trace" && what == "command" && action == "action=0")
          out.commanded.insert(activity + " " + attempt);
      });
  out.effects = effects_of(folder);
  fs::remove_all(folder);
  return out;
}

// How often each command had each effect: "kind object by activity attempt" → count. A dedicated executive commands in
// the name of what commanded it, "exec_svc/2/p1.3-…", which is left out.
std::map<std::string, int> causes_of(const nlohmann::json& effects) {
  std::map<std::string, int> out;
  for (const nlohmann::json& one : effects)
    ++out[one.value("kind", "") + " " + one.value("object", "") + " by " +
          std::regex_replace(one.value("activity", ""), std::regex("^exec_svc/[0-9]+/"), "") + " " +
          std::to_string(one.value("attempt", 0))];
  return out;
}

class Standby : public ::testing::TestWithParam<const char*> {};

TEST_P(Standby, ThatIsNeverNeededChangesNothing) {
  const Record alone = fly_and_read(GetParam(), "", "");
  const Record pair = fly_and_read(GetParam(), "", " --standby");
  EXPECT_EQ(pair.exit_code, 0);
  EXPECT_EQ(pair.summary.value("trace_sha256", "a"), alone.summary.value("trace_sha256", "b"));
  EXPECT_EQ(pair.summary.value("epoch", 0), 1);
}

TEST_P(Standby, TakesOverAndGoesOnWithTheRunningPlan) {
  const Record undisturbed = fly_and_read(GetParam(), "", "");
  ASSERT_EQ(undisturbed.summary.value("result", ""), "achieved");
  for (const char* crash : {"after-ack:3", "after-answer:1", "before-write-ahead:20", "after-write-ahead:20",
                            "after-copy:25", "during-send:9", "after-send:31,after-copy:9"}) {
    SCOPED_TRACE(crash);
    const Record flight = fly_and_read(GetParam(), crash, " --standby");
    EXPECT_EQ(flight.exit_code, 0);
    EXPECT_EQ(flight.summary.value("result", ""), "achieved");
    EXPECT_GE(flight.summary.value("epoch", 0), 2) << "it did take over";
    EXPECT_GE(flight.count("executive.resumed"), 1);
    EXPECT_EQ(flight.count("journal.diverged"), 0);
    EXPECT_EQ(flight.count("plan.adopted"), 1) << "the plan of before";
    EXPECT_EQ(flight.count("goal.achieved"), undisturbed.count("goal.achieved"));
    EXPECT_EQ(flight.commanded, undisturbed.commanded);
    expect_done_once(flight.effects);
    EXPECT_EQ(causes_of(flight.effects), causes_of(undisturbed.effects));
    EXPECT_EQ(flight.replayed.value("same", false), true) << flight.replayed;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, Standby, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return std::string(test.param); });

// The other engines' plans, with their levels, decisions and versions, are taken over likewise.
struct Flown {
  const char* name;
  const char* mission;
  const char* options;
  const char* crash;
};

class OtherEngines : public ::testing::TestWithParam<Flown> {};

TEST_P(OtherEngines, ATakeOverGoesOnWithTheRunningPlan) {
  const auto& [name, mission, options, crash] = GetParam();
  const Record undisturbed = fly_and_read("fastdds", "", options, mission);
  ASSERT_EQ(undisturbed.summary.value("result", ""), "achieved");
  const Record flight = fly_and_read("fastdds", crash, std::string(options) + " --standby", mission);
  EXPECT_EQ(flight.exit_code, 0);
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_GE(flight.summary.value("epoch", 0), 2) << "it did take over";
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  EXPECT_EQ(flight.count("journal.diverged"), 0);
  EXPECT_EQ(flight.commanded, undisturbed.commanded);
  expect_done_once(flight.effects);
  EXPECT_EQ(causes_of(flight.effects), causes_of(undisturbed.effects));
  EXPECT_EQ(flight.replayed.value("same", false), true) << flight.replayed;
}

INSTANTIATE_TEST_SUITE_P(Engines, OtherEngines,
                         ::testing::Values(Flown{"timelines", "faster", " --scenario trial", "after-send:60"},
                                           Flown{"timelines_between_commands", "faster", " --scenario trial",
                                                 "during-send:9"},
                                           Flown{"task_network", "europa-bsm1", "", "after-send:40"}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
