// The Europa lander with what MEXEC names as uncertain (section IV.C.3), a flight for each of its five groups, and one
// for an excavation that comes to nothing: whatever befalls it, the mission comes to its end,
// and goes on with what is still possible (R117).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains, ::testing::HasSubstr, ::testing::Not, ::testing::StartsWith;

class EuropaInjectors : public ::testing::Test {
 protected:
  EuropaInjectors() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/europa", mission_, fs::copy_options::recursive);
  }
  ~EuropaInjectors() override { fs::remove_all(folder_); }

  // Flies to the end of the mission in such a world, with these stimuli.
  void fly_with(const std::string& world, const std::string& stimuli) {
    std::ofstream(mission_ / "scenarios/otherwise.yaml")
        << "duration_s: 1903000\nstart: {battery: 180000000}\nworld: " << world
        << "\nstimuli:\n  - {at_s: 10, goal: {id: mission, kind: mission, importance: hard}}\n"
        << stimuli;
    const Flight flight =
        fly(mission_.string(), "inproc", 1, "--scenario otherwise --run-folder " + run_.string());
    ASSERT_EQ(flight.exit_code, 0) << flight.summary.dump();
    deeds_ = deeds_of(run_);
  }
  auto count(const std::string& begin) const {
    return std::ranges::count_if(deeds_, [&](const std::string& deed) { return deed.starts_with(begin); });
  }
  std::string journal() const { return text_of(run_ / "journal.sqlite"); }

  std::vector<std::string> deeds_;

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("roci_europa_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "mission";
  const fs::path run_ = folder_ / "run";
};

// A tenth more consumption, a sixth of the battery lost in flight, and a gauge that tells too little at the end.
TEST_F(EuropaInjectors, EnergyThatIsNotThere) {
  fly_with("{use_factor: 1.1, gauge: {below_j: 40000000, factor: 0.9}}",
           "  - {at_s: 400000, battery_loss_j: 30000000}\n");
  EXPECT_GE(count("analyze"), 1);
}

// Ice that is harder at every site and cannot be cut at one, and a trench that falls in while it is dug.
TEST_F(EuropaInjectors, ExcavationThatIsSlowStopsAndIsUndone) {
  fly_with("{hardness: 1.3, sites: {\"0\": {deepest_m: 0.06}}}",
           "  - {at_s: 40000, trench_collapses: {site: \"1\", share: 0.3}}\n");
  EXPECT_THAT(journal(), HasSubstr("too-hard"));
  EXPECT_THAT(deeds_, Not(Contains(StartsWith("collect 0 "))));
  EXPECT_THAT(deeds_, Contains(StartsWith("collect 1 ")));
  EXPECT_THAT(deeds_, Contains(StartsWith("collect 2 "))) << "the site that was given up holds up no other";
}

// The arm says that it has dug and has not: the post condition of the excavation tells.
TEST_F(EuropaInjectors, AnExcavationThatIsHollowIsDugAgain) {
  fly_with("{}", "  - {at_s: 61, hollow: {component: arm, command: excavate}}\n");
  EXPECT_GT(count("excavate 1"), 1);
  EXPECT_THAT(deeds_, Contains(StartsWith("collect 1 ")));
}

// More waste heat, larger losses, a zone that is cooled at once, and surroundings that get colder.
TEST_F(EuropaInjectors, HeatAndColdOtherThanForeseen) {
  fly_with("{waste_factor: 1.3, loss_factor: 1.2}",
           "  - {at_s: 100000, heat: {zone: arm, joules: -20000}}\n  - {at_s: 300000, surroundings: {kelvin: "
           "85}}\n");
  EXPECT_GE(count("analyze"), 1);
}

// A store that is soon full, half the rate from the second sample on,
// and Earth that is hidden when it should be in view.
TEST_F(EuropaInjectors, DataThatFindNoRoomAndNoWay) {
  fly_with("{data_capacity_bytes: 80000000}",
           "  - {at_s: 130000, rate: {component: radio, factor: 0.5}}\n"
           "  - {at_s: 303000, blocked_view: {window: earth.window, for_s: 20000}}\n");
  EXPECT_THAT(journal(), HasSubstr("contact-lost"));
  EXPECT_GE(count("analyze"), 1);
}

// Everything takes longer, a transport succeeds without being true,
// the laboratory fails and the arm is slow for a time.
TEST_F(EuropaInjectors, TasksThatFailAreSlowOrComeToNothing) {
  fly_with("{duration_factor: 1.15}",
           "  - {at_s: 61, hollow: {component: arm, command: transport}}\n"
           "  - {at_s: 310000, fault: {component: laboratory, for_s: 40000}}\n"
           "  - {at_s: 330000, fault: {component: arm, for_s: 20000, slow: 2}}\n");
  EXPECT_GT(count("collect"), count("analyze")) << "the sample that never arrived is not analyzed";
  EXPECT_GE(count("analyze"), 1);
}

}  // namespace
}  // namespace roci::scenario
