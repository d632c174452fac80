// The Europa lander with what MEXEC names as uncertain (section IV.C.3), a flight for each of its five groups, and one
// for an excavation that comes to nothing: each injector is seen in what was observed, whatever befalls the lander the
// mission comes to its end, and it goes on with what is still possible (R117). One flight that nothing befalls is what
// all are held against, so all cases are one test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/scenario/europa_course.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf, ::testing::Contains, ::testing::Ge, ::testing::HasSubstr, ::testing::Le,
    ::testing::Not, ::testing::StartsWith;

using Readings = std::map<std::string, std::vector<Reading>>;

std::vector<double> values(const Readings& of, const std::string& timeline) {
  std::vector<double> out;
  for (const Reading& one : of.at(timeline)) out.push_back(std::stod(one.value));
  return out;
}
double highest(const Readings& of, const std::string& timeline) {
  return std::ranges::max(values(of, timeline));
}
double lowest(const Readings& of, const std::string& timeline) {
  return std::ranges::min(values(of, timeline));
}

double value_at(const Readings& of, const std::string& timeline, double at_s) {
  double out = 0;
  for (const Reading& one : of.at(timeline))
    if (one.at_s <= at_s) out = std::stod(one.value);
  return out;
}

// What the battery gives in a night in which nothing is done: the median of what was told of it there.
double quiet_w(const Readings& of, double from_s, double to_s) {
  std::vector<double> watts;
  const std::vector<Reading>& told = of.at("lander.battery");
  for (std::size_t i = 1; i < told.size(); ++i)
    if (const double took_s = told[i].at_s - told[i - 1].at_s;
        told[i - 1].at_s >= from_s && told[i].at_s < to_s && took_s > 250)
      watts.push_back((std::stod(told[i - 1].value) - std::stod(told[i].value)) / took_s);
  if (watts.empty()) return 0;
  std::ranges::nth_element(watts, watts.begin() + static_cast<std::ptrdiff_t>(watts.size() / 2));
  return watts[watts.size() / 2];
}

// How long a component was in a state of that name when it was so first, at that time or later.
double lasted_s(const Readings& of, const std::string& component, const std::string& state,
                double since_s = 0) {
  const std::vector<Reading>& told = of.at(component);
  for (std::size_t i = 0; i + 1 < told.size(); ++i)
    if (told[i].at_s >= since_s && told[i].value.starts_with(state)) return told[i + 1].at_s - told[i].at_s;
  return 0;
}

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
    usual();
    ASSERT_EQ(fly_until(1'903'000, world, stimuli), 0);
    deeds_ = deeds_of(run_);
    told_ = readings(run_, "lander.");
  }
  auto count(const std::string& begin) const {
    return std::ranges::count_if(deeds_, [&](const std::string& deed) { return deed.starts_with(begin); });
  }
  std::string journal() const { return text_of(run_ / "journal.sqlite"); }
  // What is observed of the first days where nothing befalls the lander.
  const Readings& usual() {
    static Readings known;
    if (known.empty()) {
      fly_until(420'000, "{}", "");
      known = readings(run_, "lander.");
    }
    return known;
  }
  // Bytes a second within downlinks that begin in that time.
  double rate(double from_s, double to_s) const {
    const Course course(run_);
    double bytes = 0, took_s = 0;
    const Course::Deed* before = nullptr;
    for (const Course::Deed& deed : course.deeds()) {
      if (deed.kind != "downlink") continue;
      const bool follows = before != nullptr && before->activity == deed.activity;
      if (follows && before->at_s >= from_s && deed.at_s < to_s) {
        bytes += std::ranges::find(course.products(), deed.object, &Course::Product::id)->bytes;
        took_s += deed.at_s - before->at_s;
      }
      before = &deed;
    }
    return took_s > 0 ? bytes / took_s : 0;
  }

  std::vector<std::string> deeds_;
  Readings told_;

 private:
  int fly_until(int end_s, const std::string& world, const std::string& stimuli) const {
    std::ofstream(mission_ / "scenarios/otherwise.yaml")
        << "duration_s: " << end_s << "\nstart: {battery: 180000000}\nworld: " << world
        << "\nstimuli:\n  - {at_s: 10, goal: {id: mission, kind: mission, importance: hard}}\n"
        << stimuli;
    fs::remove_all(run_);
    return fly(mission_.string(), "inproc", 1, "--scenario otherwise --run-folder " + run_.string())
        .exit_code;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_europa_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "mission";
  const fs::path run_ = folder_ / "run";
};

// A tenth more consumption, a sixth of the battery lost in flight, and a gauge that tells too little at the end.
TEST_F(EuropaInjectors, EnergyThatIsNotThere) {
  fly_with("{use_factor: 1.1, gauge: {below_j: 40000000, factor: 0.9}}",
           "  - {at_s: 400000, battery_loss_j: 30000000}\n");
  const double usual_w = quiet_w(usual(), 240'000, 300'000);
  EXPECT_NEAR(usual_w, 20.5, 0.1) << "mission.yaml";
  EXPECT_NEAR(quiet_w(told_, 240'000, 300'000), 1.1 * usual_w, 0.1);
  const double lost_j =
      value_at(told_, "lander.battery", 399'999) - value_at(told_, "lander.battery", 400'301);
  EXPECT_THAT(lost_j, AllOf(Ge(30e6), Le(30.5e6)));
  EXPECT_LT(value_at(told_, "lander.battery", 1'450'000), 40e6);
  EXPECT_NEAR(quiet_w(told_, 1'450'000, 1'500'000), 0.9 * 1.1 * usual_w, 0.1) << "what the gauge tells of it";
  EXPECT_GE(count("analyze"), 1);
}

// Ice that is harder at every site and cannot be cut at one, and a trench that falls in while it is dug.
TEST_F(EuropaInjectors, ExcavationThatIsSlowStopsAndIsUndone) {
  fly_with("{hardness: 1.3, sites: {\"0\": {deepest_m: 0.06}}}",
           "  - {at_s: 40000, trench_collapses: {site: \"1\", share: 0.3}}\n");
  const std::string depth = "lander.arm.depth_1";
  const double before_m = value_at(told_, depth, 39'999), usual_m = value_at(usual(), depth, 39'999);
  EXPECT_NEAR(usual_m / before_m, 1.3, 0.1) << "it is slower";
  EXPECT_NEAR(value_at(told_, depth, 40'301), 0.3 * before_m, 0.002) << "what is left of the trench";
  EXPECT_TRUE(std::ranges::is_sorted(values(usual(), depth)));
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

// More waste heat, larger losses, a zone that is cooled at once, and surroundings that get colder. What all zones need
// at rest follows from mission.yaml: 9 W for the electronics and their losses to 100 K, later to 85 K.
TEST_F(EuropaInjectors, HeatAndColdOtherThanForeseen) {
  fly_with("{waste_factor: 1.3, loss_factor: 1.2}",
           "  - {at_s: 100000, heat: {zone: arm, joules: -20000}}\n  - {at_s: 300000, surroundings: {kelvin: "
           "85}}\n");
  EXPECT_NEAR(quiet_w(usual(), 240'000, 300'000), 9 + 11.5, 0.1);
  EXPECT_NEAR(quiet_w(told_, 240'000, 300'000), 9 + 1.2 * 11.5, 0.1);
  EXPECT_NEAR(quiet_w(told_, 540'000, 600'000), 9 + 1.2 * (11.5 + 15 * 0.33), 0.1);
  EXPECT_EQ(lowest(usual(), "lander.heat.arm"), 120) << "the thermostat keeps it there";
  EXPECT_LT(lowest(told_, "lander.heat.arm"), 105);
  // By 11.5 W of waste and the larger losses alone a session would end below the 200 K at which it begins.
  EXPECT_GT(highest(told_, "lander.heat.antenna"), 204);
  EXPECT_GE(count("analyze"), 1);
}

// A store that is soon full, half the rate from the second sample on,
// and Earth that is hidden when it should be in view.
TEST_F(EuropaInjectors, DataThatFindNoRoomAndNoWay) {
  fly_with("{data_capacity_bytes: 55000000}",
           "  - {at_s: 130000, rate: {component: radio, factor: 0.5}}\n"
           "  - {at_s: 303000, blocked_view: {window: earth.window, for_s: 20000}}\n");
  EXPECT_NEAR(rate(0, 130'000), 6500, 400);
  EXPECT_NEAR(rate(130'000, 1'903'000), 3250, 200);
  EXPECT_THAT(journal(), HasSubstr("data-full"));
  EXPECT_THAT(journal(), HasSubstr("contact-lost"));
  EXPECT_GE(count("analyze"), 1);
}

// Everything takes longer, a transport succeeds without being true,
// the laboratory fails and the arm is slow for a time.
TEST_F(EuropaInjectors, TasksThatFailAreSlowOrComeToNothing) {
  fly_with("{duration_factor: 1.15}",
           "  - {at_s: 61, hollow: {component: arm, command: transport}}\n"
           "  - {at_s: 330000, fault: {component: arm, for_s: 20000, slow: 2}}\n"
           "  - {at_s: 415000, fault: {component: laboratory, for_s: 3000}}\n");
  EXPECT_NEAR(lasted_s(told_, "lander.camera", "surveying") / lasted_s(usual(), "lander.camera", "surveying"),
              1.15, 0.01);
  EXPECT_NEAR(lasted_s(told_, "lander.arm", "digging(0)") - lasted_s(usual(), "lander.arm", "digging(0)"),
              10'000, 500)
      << "half of the time in which it was slow";
  EXPECT_THAT(journal(), HasSubstr("stage=3 sim_svc fault ")) << "the laboratory was analyzing";
  EXPECT_GT(count("collect"), count("analyze")) << "the sample that never arrived is not analyzed";
  EXPECT_GE(count("analyze"), 1);
}

}  // namespace
}  // namespace roci::scenario
