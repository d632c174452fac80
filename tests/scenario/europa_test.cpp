// Both reference missions of the Europa lander, flown by every service as a process of its own: Basic Surface Mission 1, and Reference Surface
// Mission 1 in the scenarios of MEXEC, section V.B (R107–R109, R112, R114, R124, R127). Built twice: with some scenarios for ./check, with all of
// them for ./check --full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::Each, ::testing::Ge, ::testing::Le;

const std::string kMissions = std::string(ROCI_SOURCE_DIR) + "/missions/";

/// Says for a flight by which mission and scenario it goes, where these are not `europa` and the flight's own name.
const std::map<std::string, std::pair<std::string, std::string>> kElsewhere{
    {"basic", {"europa-bsm1", "nominal"}},
    {"autonomous", {"europa-autonomous", "nominal"}},
};

/// Is what a flight has done, read from the world's own record.
class Course {
 public:
  explicit Course(const fs::path& run_folder) : deeds_(deeds_of(run_folder)) {}

  const std::vector<std::string>& deeds() const { return deeds_; }
  bool has(const std::string& deed) const { return std::ranges::find(deeds_, deed) != deeds_.end(); }
  /// Returns "site target" of each sample, in the order of their collection.
  std::vector<std::string> samples() const { return objects("collect "); }
  std::vector<std::string> samples_at(const std::string& site) const {
    std::vector<std::string> out;
    for (const std::string& one : samples())
      if (one.starts_with(site + " ")) out.push_back(one);
    return out;
  }
  /// Returns "site_target" of each sample that was analyzed.
  std::vector<std::string> analyzed() const { return objects("analyze "); }
  std::vector<std::string> sites() const { return objects("excavate "); }
  std::size_t count(const std::string& kind) const { return objects(kind + " ").size(); }
  /// Returns how many blocks begin, and how many of them without an uplink since the one before that would have
  /// released the hold.
  std::pair<int, int> blocks_and_those_unreleased() const {
    std::pair<int, int> out;
    bool released = false, discarded = false;
    for (const std::string& deed : deeds_) {
      released |= deed.starts_with("receive p_uplink_");
      const bool collects = deed.starts_with("collect "), discards = deed.starts_with("discard ");
      if (!deed.starts_with("excavate ") && !collects && !discards) continue;
      if (collects && std::exchange(discarded, false)) continue;  // the same block
      discarded = discards;
      ++out.first;
      if (!std::exchange(released, false)) ++out.second;
    }
    return out;
  }

 private:
  std::vector<std::string> objects(const std::string& kind) const {
    std::vector<std::string> out;
    for (const std::string& deed : deeds_)
      if (deed.starts_with(kind)) out.push_back(deed.substr(kind.size()));
    return out;
  }

  std::vector<std::string> deeds_;
};

/// Returns what was observed of the numeric timelines whose names begin so, in the flight's own trace.
std::map<std::string, std::vector<double>> observed(const fs::path& run_folder, const std::string& prefix) {
  std::map<std::string, std::vector<double>> out;
  std::istringstream lines(run("roci-trace print " + (run_folder / "journal.sqlite").string()).output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string at, kind, timeline;
    double value = 0;
    if (words >> at >> kind >> timeline >> value && kind == "observation" && timeline.starts_with(prefix))
      out[timeline].push_back(value);
  }
  return out;
}

/// What is sent of a sample, and what is worth the more for it (model.yaml).
double worth(const Course& course) {
  double out = 0;
  for (const std::string& deed : course.deeds()) {
    if (deed.starts_with("downlink raw_")) out += 0.6;
    if (deed.starts_with("downlink compressed_")) out += 0.4;
    if (deed.starts_with("downlink panorama") || deed.starts_with("downlink quakes")) out += 0.1;
  }
  return out;
}

class Europa : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  ~Europa() override { fs::remove_all(folder_); }

  Flight flight_of(const std::string& of, const std::string& transport) const {
    fs::remove_all(folder_);
    const auto elsewhere = kElsewhere.find(of);
    const auto& [mission, file] =
        elsewhere == kElsewhere.end() ? std::pair<std::string, std::string>("europa", of) : elsewhere->second;
    return fly(kMissions + mission, transport, 1, "--scenario " + file + " --run-folder " + folder_.string());
  }
  /// Returns the trace of the same scenario over inproc, and what came home then.
  static std::pair<std::string, double>& reference(const std::string& of) {
    static std::map<std::string, std::pair<std::string, double>> known;
    return known[of];
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_europa_" + std::to_string(::getpid()));
  const std::string scenario = std::get<0>(GetParam());
  const std::string dds = std::get<1>(GetParam());
};

// In all of them: the mission ends as it should, every sample that was analyzed is on Earth, no site has more than three, and no zone is out
// of its range (mission.yaml).
void check_rules(const Course& course, const fs::path& run_folder) {
  for (const std::string& sample : course.analyzed()) {
    EXPECT_TRUE(course.has("downlink summary_" + sample))
        << sample << " was analyzed, and its summary not sent";
    EXPECT_TRUE(course.has("downlink raw_" + sample) || course.has("downlink compressed_" + sample))
        << sample;
  }
  EXPECT_EQ(course.samples().size(), course.analyzed().size());
  for (const char* site : {"0", "1", "2"}) EXPECT_THAT(course.samples_at(site).size(), Le(3U));
  const auto heat = observed(run_folder, "lander.heat.");
  EXPECT_EQ(heat.size(), 3U);
  for (const auto& [zone, kelvins] : heat)
    EXPECT_THAT(kelvins, Each(Ge(zone.ends_with("vault") ? 240 : 84))) << zone;
}

using Rule = void (*)(const Course&);

// What success is in each scenario. Sites go by value: 1, 0, 2; targets by their looks: 1 has 0, 1, 2, 0 has 2, 0, 1, 2 has 1, 2, 0.
const std::map<std::string, Rule> kRules{
    {"nominal",
     [](const Course& course) {
       EXPECT_FALSE(course.samples().empty());
       const auto [blocks, unreleased] = course.blocks_and_those_unreleased();
       EXPECT_THAT(blocks, Ge(6));
       EXPECT_EQ(unreleased, 0) << "fully_autonomous is no";
     }},
    {"autonomous",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (std::vector<std::string>{"1 0", "0 2", "2 1"}));
       EXPECT_THAT(course.blocks_and_those_unreleased().second, Ge(1)) << "no block waits for the ground";
     }},
    {"ground_lets_go",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (std::vector<std::string>{"1 0", "0 2", "2 1"}));
       EXPECT_THAT(course.blocks_and_those_unreleased().second, Ge(1)) << "no block waits any more";
     }},
    // R108.
    {"basic",
     [](const Course& course) {
       EXPECT_EQ(course.sites(), std::vector<std::string>{"0"});
       EXPECT_THAT(course.samples(), ::testing::UnorderedElementsAre("0 0", "0 1", "0 2"));
       EXPECT_THAT(course.count("panorama"), Ge(5U)) << "one now and then";
       EXPECT_THAT(course.count("start"), Ge(5U)) << "days of seismometry";
       EXPECT_EQ(course.count("receive"), 0U) << "there is no ground";
       EXPECT_TRUE(course.has("downlink quakes"));
     }},
    // From the uplink on one target at each site, though each has a signature; the one before is the first at its site.
    {"ground_one_target",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (std::vector<std::string>{"1 0", "0 2", "2 1"}));
     }},
    {"all_positive",
     [](const Course& course) {
       const std::vector<std::string> order{"1 0", "1 1", "1 2", "0 2", "0 0", "0 1", "2 1", "2 2", "2 0"};
       const auto samples = course.samples();
       ASSERT_THAT(samples.size(), Ge(7U)) << "up to three at each site, in the order of their values";
       for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], order[i]);
     }},
    {"all_negative",
     [](const Course& course) {
       EXPECT_EQ(course.samples(), (std::vector<std::string>{"1 0", "0 2", "2 1"}));
     }},
    {"first_negative",
     [](const Course& course) {
       const std::vector<std::string> order{"1 0", "0 2", "0 0", "0 1", "2 1", "2 2", "2 0"};
       const auto samples = course.samples();
       ASSERT_THAT(samples.size(), Ge(6U));
       for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], order[i]);
     }},
    {"low_start", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(2U)); }},
    {"sudden_low", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(1U)); }},
    {"ground_reorders",
     [](const Course& course) {
       EXPECT_EQ(course.sites(), (std::vector<std::string>{"1", "2", "0"}));
     }},
    {"more_decisional",
     [](const Course& course) {
       for (const std::string& site : course.sites())
         EXPECT_TRUE(course.has("downlink trench_" + site)) << site;
     }},
    {"more_mandatory", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(3U)); }},
    {"comm_energy_35", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(7U)); }},
    {"cold_85K", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(5U)); }},
    {"slow_downlink", [](const Course& course) { EXPECT_THAT(course.samples().size(), Ge(3U)); }},
};

TEST_P(Europa, SucceedsWithTheTraceOfTheReference) {
  auto& [trace, home] = reference(scenario);
  if (trace.empty() && dds != "inproc") {
    trace = flight_of(scenario, "inproc").summary.value("trace_sha256", "no trace");
  }
  const Flight flight = flight_of(scenario, dds);
  EXPECT_EQ(flight.exit_code, 0) << flight.summary.dump();
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_EQ(flight.summary.value("dds", ""), dds);
  EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "");
  const Course course(folder_);
  check_rules(course, folder_);
  kRules.at(scenario)(course);
  home = worth(course);
  if (trace.empty()) trace = flight.summary.value("trace_sha256", "");
  EXPECT_EQ(flight.summary.value("trace_sha256", ""), trace);
  if (scenario == "comm_energy_35" && reference("all_positive").second > 0) {
    EXPECT_GE(home, reference("all_positive").second) << "a limit was lifted";
  }
}

std::string name_of(const ::testing::TestParamInfo<Europa::ParamType>& test) {
  return std::get<0>(test.param) + "_" + std::get<1>(test.param);
}

#ifdef ROCI_ALL_SCENARIOS
const auto kScenarios =
    ::testing::Values("nominal", "all_positive", "all_negative", "first_negative", "low_start", "sudden_low",
                      "ground_reorders", "more_decisional", "more_mandatory", "comm_energy_35", "cold_85K",
                      "slow_downlink", "ground_one_target", "ground_lets_go", "autonomous", "basic");
INSTANTIATE_TEST_SUITE_P(AllScenarios, Europa,
                         ::testing::Combine(kScenarios,
                                            ::testing::Values("inproc", "fastdds", "cyclonedds", "mixed")),
                         name_of);
#else
INSTANTIATE_TEST_SUITE_P(Scenarios, Europa,
                         ::testing::Combine(::testing::Values("all_negative"),
                                            ::testing::Values("fastdds", "cyclonedds", "mixed")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Alone, Europa,
                         ::testing::Combine(::testing::Values("first_negative", "sudden_low", "basic"),
                                            ::testing::Values("inproc")),
                         name_of);
#endif

}  // namespace
}  // namespace roci::scenario
