// The trial of missions/faster behind a radio that loses a fifth of what is said, one flight for each of fifty seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/scenario/heard_flight.hpp"
#include "tests/scenario/radio_losses.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FasterRadio : ::testing::TestWithParam<std::uint64_t> {
  FasterRadio() {
    fs::create_directories(folder);
    fs::copy(ROCI_SOURCE_DIR "/missions/faster", folder / "faster", fs::copy_options::recursive);
  }
  ~FasterRadio() override { fs::remove_all(folder); }
  const fs::path folder = fs::temp_directory_path() / ("roci_faster_radio_" + std::to_string(::getpid()));
};

constexpr double kBound_s = 300;  // `map_within_s` of FollowPath in missions/faster/primary_locomotion.yaml

double told_s(const v1::CommandAck& answer) {
  for (const v1::NamedValue& value : answer.outcome().measured())
    if (value.name() == "told_s") return value.held().number();
  return -1;
}

// How old the scout's newest patch in the primary's map was as each drive of the primary was commanded, in seconds: by
// the merge that its dedicated executive had an answer to last.
std::vector<double> map_ages(const HeardFlight& flight) {
  std::vector<double> out;
  for (const v1::Command& command : flight.commands) {
    if (command.commander() != "primary.locomotion" || command.command_name() != "drive" ||
        command.action() != v1::COMMAND_EXECUTE)
      continue;
    double told = -1;
    for (const v1::CommandAck& answer : flight.answers)
      if (answer.commander() == command.commander() && answer.owner() == "primary.path" &&
          answer.stage() == v1::STAGE_COMPLETED && answer.header().stamp_us() <= command.header().stamp_us())
        told = std::max(told, told_s(answer));
    out.push_back(double(command.header().stamp_us()) / 1e6 - told);
  }
  return out;
}

// The target is reached, no call of a decision has two effects, and what was lost has a name for what is done about it.
TEST_P(FasterRadio, TheTeamArrivesAndNothingIsDoneTwice) {
  const HeardFlight flight = hear_flight(folder / "faster", "radio_loss", folder / "run", GetParam());
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  std::set<std::string> keys;
  for (const json& deed : flight.deeds) {
    const std::string key = deed["commander"].get<std::string>() + " " + deed["activity"].get<std::string>() +
                            " " + deed["attempt"].dump();
    EXPECT_TRUE(keys.insert(key).second) << key;
  }
  EXPECT_FALSE(keys.empty());
  const std::vector<double> ages = map_ages(flight);
  EXPECT_GE(ages.size(), 9U) << "one for each way of the route";
  EXPECT_THAT(ages, ::testing::Each(::testing::Le(kBound_s)));
  RecordProperty("oldest_map_s", std::to_string(ages.empty() ? 0 : *std::ranges::max_element(ages)));
  RecordProperty("replans", flight.summary["replans"].dump());
  const auto all = losses_of(folder / "run");
  EXPECT_FALSE(all.empty());
  for (const auto& [service, losses] : all) {
    for (const json& loss : losses) {
      EXPECT_NE(loss["effect"], "never heard") << loss;
      if (loss["effect"] == "asked for") expect_asked_for(flight, loss);
    }
    expect_all_named(folder / "run", service, losses);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FasterRadio, ::testing::Range<std::uint64_t>(1, 51),
                         [](const auto& test) { return "seed_" + std::to_string(test.param); });

}  // namespace
}  // namespace roci::scenario
