// The trial of missions/faster behind a radio that loses a fifth of what is said, one flight for each of fifty seeds.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>

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
