// The twelve scenarios of MEXEC, section V.B, beside twins whose planner learns all that is true at the moment of the surprise (R124).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "tests/scenario/europa_truth.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/scenario/heard_flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
namespace reading = planner::utility_htn::reading;
using planner::utility_htn::model::Network;

/// Says what comes as a surprise, and when.
struct Surprise {
  double at_s = 5;  ///< before the first plan
  std::map<std::string, bool> signatures{};
  std::string network = "network-rsm1.yaml";  ///< that is in force from then on
};

const std::map<std::string, bool> kAllNegative{{"0_0", false}, {"0_1", false}, {"0_2", false},
                                               {"1_0", false}, {"1_1", false}, {"1_2", false},
                                               {"2_0", false}, {"2_1", false}, {"2_2", false}};

const std::map<std::string, Surprise> kSurprises{
    {"all_positive", {}},
    {"all_negative", {103300, kAllNegative}},
    {"first_negative", {103300, {{"1_0", false}}}},
    {"low_start", {}},
    {"sudden_low", {230000}},
    {"ground_reorders", {60000, kAllNegative}},
    {"ground_one_target", {60000, {}, "network-one-target.yaml"}},
    {"more_decisional", {}},
    {"more_mandatory", {}},
    {"comm_energy_35", {}},
    {"cold_85K", {}},
    {"slow_downlink", {190000}},
};

class Knowing : public ::testing::TestWithParam<std::string> {
 protected:
  Knowing() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/europa", mission_, fs::copy_options::recursive);
  }
  ~Knowing() override { fs::remove_all(folder_); }

  HeardFlight hear(const std::string& scenario) const {
    return hear_flight(mission_, scenario, folder_ / scenario);
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_knowing_" + std::to_string(::getpid()));
  const fs::path mission_ = folder_ / "europa";
};

TEST_P(Knowing, ATwinBringsHomeLittleMore) {
  const Surprise& surprise = kSurprises.at(GetParam());
  const Network foreseen = reading::load_network(mission_ / surprise.network);
  const HeardFlight flight = hear(GetParam());
  ASSERT_EQ(flight.summary.value("result", ""), "achieved");

  const Network truth = truth_of(foreseen, flight, surprise.at_s, surprise.signatures);
  for (std::size_t i = 0; i < truth.parameters.size(); ++i)
    if (truth.parameters[i].prior != foreseen.parameters[i].prior)
      std::printf("%s %g -> %g\n", truth.parameters[i].name.c_str(), foreseen.parameters[i].prior,
                  truth.parameters[i].prior);
  std::ofstream(mission_ / "truth.htn", std::ios::binary) << reading::to_binary(truth);
  fs::copy(mission_ / "scenarios" / (GetParam() + ".yaml"), mission_ / "scenarios/twin.yaml");
  edit(mission_ / "scenarios/twin.yaml", "expect:\n",
       "  - {at_s: " + std::to_string(surprise.at_s) +
           ", network: {id: truth, file: ../truth.htn}}\nexpect:\n");
  const HeardFlight twin = hear("twin");
  ASSERT_EQ(twin.summary.value("result", ""), "achieved");
  const auto home = received(foreseen, flight), most = received(foreseen, twin);
  for (std::size_t rank = 0; rank < home.size(); ++rank)
    std::printf("%s %s: %g of %g\n", GetParam().c_str(), foreseen.ranks[rank].c_str(), home[rank],
                most[rank]);
  const char* which = "flight";
  for (const HeardFlight* one : {&flight, &twin}) {
    for (const auto& deed : one->deeds)
      if (deed["kind"] == "collect")
        std::printf("%s collect %s %g\n", which, deed["object"].get<std::string>().c_str(), deed["time_us"].get<double>() / 1e6);
    for (const auto& event : one->events)
      if ((event.code().starts_with("planner.cyc") && getenv("CYC")) || event.code().starts_with("planner.net") ||
          event.code().starts_with("planner.def"))
        std::printf("%s %g %s %s\n", which, event.header().stamp_us() / 1e6, event.code().c_str(), event.text().c_str());
    which = "twin";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Knowing,
                         ::testing::Values("all_positive", "all_negative", "first_negative", "low_start",
                                           "sudden_low", "ground_reorders", "ground_one_target",
                                           "more_decisional", "more_mandatory", "comm_energy_35", "cold_85K",
                                           "slow_downlink"),
                         [](const auto& scenario) { return scenario.param; });

}  // namespace
}  // namespace roci::scenario
