// The radio between two rovers loses a fifth of what is said over it, or is away for minutes; one executive, on the
// primary's side, commands both through dedicated executives.
// The scenarios radio_loss and radio_cut of tests/missions/convoy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"
#include "tests/scenario/heard_flight.hpp"
#include "tests/scenario/radio_losses.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr char kMission[] = ROCI_SOURCE_DIR "/tests/missions/convoy";
constexpr std::uint64_t kSeeds = 50;

fs::path made_folder(const std::string& name) {
  return fs::temp_directory_path() / ("roci_convoy_radio_" + name + "_" + std::to_string(::getpid()));
}

class Radio : public ::testing::TestWithParam<const char*> {
 protected:
  ~Radio() override {
    fs::remove_all(folder_);
    fs::remove_all(reference_);
  }

  // What happens, what it came to and what was lost on the way are the same on every transport.
  void expect_as_listed(const std::string& scenario) {
    const auto flown = [&](const std::string& dds, const fs::path& folder) {
      return fly(kMission, dds, 1, "--scenario " + scenario + " --run-folder " + folder.string());
    };
    const Flight flight = flown(GetParam(), folder_);
    EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
    EXPECT_FALSE(losses_of(folder_).empty());
    if (GetParam() == std::string("inproc")) return;
    const Flight reference = flown("inproc", reference_);
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference.summary.value("trace_sha256", "no trace"));
    EXPECT_EQ(losses_of(folder_), losses_of(reference_));
  }

  const fs::path folder_ = made_folder("run");
  const fs::path reference_ = made_folder("reference");
};

TEST_P(Radio, AFifthIsLost) { expect_as_listed("radio_loss"); }

TEST_P(Radio, MinutesAreCut) { expect_as_listed("radio_cut"); }

INSTANTIATE_TEST_SUITE_P(Transports, Radio, ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed"),
                         [](const auto& dds) { return std::string(dds.param); });

struct Seeds : ::testing::TestWithParam<const char*> {
  ~Seeds() override { fs::remove_all(folder); }
  const fs::path folder = made_folder("seeds");
};

// The target is reached for every seed, no decision has two effects,
// and nothing is lost without a name for what is done about it.
TEST_P(Seeds, TheTargetIsReachedAndNoDecisionIsCarriedOutTwice) {
  fs::create_directories(folder);
  fs::copy(kMission, folder / "convoy", fs::copy_options::recursive);
  std::set<std::string> effects;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const fs::path run_folder = folder / ("run" + std::to_string(seed));
    const HeardFlight flight = hear_flight(folder / "convoy", GetParam(), run_folder, seed);
    EXPECT_EQ(flight.summary.value("result", ""), "achieved");
    std::map<std::string, int> deeds;  // of one decision of the plan, whatever became of its calls
    for (const json& deed : flight.deeds) {
      const auto decision = deed["activity"].get<std::string>();
      ++deeds[decision.substr(0, decision.rfind('/')) + " " + deed["kind"].get<std::string>()];
    }
    for (const auto& [what, times] : deeds) EXPECT_EQ(times, 1) << what;
    for (const auto& [service, losses] : losses_of(run_folder)) {
      for (const json& loss : losses) {
        effects.insert(loss["effect"]);
        EXPECT_NE(loss.value("key", ""), "") << loss;
        if (loss["effect"] == "asked for") expect_asked_for(flight, loss);
      }
      expect_all_named(run_folder, service, losses);
    }
    fs::remove_all(run_folder);
  }
  EXPECT_TRUE(effects.contains("asked for"));
  EXPECT_TRUE(effects.contains("sent again") || effects.contains("superseded"));
  EXPECT_FALSE(effects.contains("never heard"));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Seeds, ::testing::Values("radio_loss", "radio_cut"),
                         [](const auto& scenario) { return std::string(scenario.param); });

// Half is lost, and the radio is away again and again, for each seed at other times: where the plan is given up, that
// is said, and nothing was done twice.
TEST_F(Seeds, AWorseRadioEndsAsStated) {
  fs::create_directories(folder);
  fs::copy(kMission, folder / "convoy", fs::copy_options::recursive);
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::string cuts;
    for (std::uint64_t i = 0, at = 11 + seed * 7 % 60; i < 4; ++i, at += 150 + seed * 13 % 80)
      cuts += (i == 0 ? "[" : ", [") + std::to_string(at) + ", " +
              std::to_string(at + 40 + seed * (i + 3) % 90) + "]";
    std::string text = text_of(fs::path(kMission) / "scenarios/radio_loss.yaml");
    text = text.substr(0, text.find("expect:")) + "expect: [\"goal.accepted: far\"]\n";
    for (auto at = text.find("loss: 0.2"); at != std::string::npos; at = text.find("loss: 0.2"))
      text.replace(at, 9, "loss: 0.5, cuts: [" + cuts + "]");
    std::ofstream(folder / "convoy/scenarios/worse.yaml") << text;
    const fs::path run_folder = folder / "run";
    const HeardFlight flight = hear_flight(folder / "convoy", "worse", run_folder, seed);
    const std::string result = flight.summary.value("result", "");
    reached += result == "achieved" ? 1 : 0;
    const auto told = [&](const std::string& code) {
      return std::ranges::any_of(flight.events, [&](const v1::Event& event) { return event.code() == code; });
    };
    EXPECT_TRUE(result == "achieved" || told("goal.failed") || told("robot.safing") || told("robot.safe"))
        << result;
    std::set<std::string> keys;
    for (const json& deed : flight.deeds) {
      const std::string key = deed["activity"].get<std::string>() + deed["attempt"].dump();
      EXPECT_TRUE(keys.insert(key).second) << key;
    }
    fs::remove_all(run_folder);
  }
  EXPECT_GE(reached, 40) << "of " << kSeeds;
}

}  // namespace
}  // namespace roci::scenario
